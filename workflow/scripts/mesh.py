"""Write the coarsest labelled triangulation of a domain."""

import json

from stage import options, run

from signorini.mesh.domain import Domain, write_domain


@options("--domain", "--output")
def main(arguments):
    """Sections domain and boundary of a scene, as JSON, to a file that every level is refined from."""
    domain = Domain.from_mapping(**json.loads(arguments.domain))
    write_domain(arguments.output, domain)
    return f"mesh: rectangle of {domain.size[0]:g} by {domain.size[1]:g}, {domain.diagonal} diagonals"


if __name__ == "__main__":
    run(main, __doc__)
