"""The paper's statements held against numbers: both sides of each inequality, computed apart."""
