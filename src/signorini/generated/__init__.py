"""Problems made by seeds: for studies and tests, in numbers that nobody writes by hand.

- `bodies`: families of meshes with labels, some with a diffusion coefficient.
- `problems`: such a body under a kind of load.
- `numbering`: a mesh numbered at random.
- `scenes`: strategies of Hypothesis for scenes.
- `statements`: what these and others state alike.
"""
