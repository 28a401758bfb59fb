"""What a program says and gets: problems from meshes and functions, solutions that tell more.

It takes the way of a scene: both become a `ProblemStatement`, which `fem.problem` discretises.
"""
