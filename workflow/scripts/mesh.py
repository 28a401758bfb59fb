"""Make the domain of a scene: what every level is refined from."""

import json

from stage import options, run

from signorini.mesh.domain import make_domain, write_domain


@options("--domain", "--output")
def main(arguments):
    """Sections domain and boundary of a scene and its coarsest level, as JSON, to a file for all
    levels.
    """
    statement = json.loads(arguments.domain)
    domain = make_domain(**statement)
    write_domain(arguments.output, domain)
    triangles = domain.level(statement["coarsest"]).number_of_triangles
    return (
        f"mesh: {statement['domain']['kind']}, {triangles} triangles at n = {statement['coarsest']}"
    )


if __name__ == "__main__":
    run(main, __doc__)
