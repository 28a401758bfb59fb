"""Studies: what is measured about the solvers beyond a scene.

They know the library; the library knows no study.
"""
