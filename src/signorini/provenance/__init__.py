"""What was built, from what, by what and where; and whether a folder of results is still that.

`build` describes a build, in ``results/provenance.json``; `verify` holds a folder against it.
"""
