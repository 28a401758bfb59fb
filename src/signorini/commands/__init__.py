"""The command line: one file for each command, loaded when that command is called."""
