"""From numbers to what is read: tables, macros, the check against a paper, the paper, VTU files."""
