"""From numbers to what is read: tables, macros, comparison with published numbers, the typeset
paper, VTU files.
"""
