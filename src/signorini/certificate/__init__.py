"""Guaranteed error bounds, from the solutions of both elements alone: no truth is needed.

`certify.certify_level` makes them; docs/certificate.md proves them.
"""
