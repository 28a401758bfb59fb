"""From results to an article: published numbers, numbers by key, macros, and LaTeX."""
