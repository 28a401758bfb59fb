"""Draw how near each combination comes to the paper's table, and the ratio of the elements' errors,
to PDF and PNG.
"""

from stage import options, run

from signorini.figures.sensitivity import draw_matches, draw_ratios
from signorini.figures.style import save_figure
from signorini.storage import read_csv


@options(
    "--combinations", "--ratios", ("--matches-to", {"nargs": "+"}), ("--ratios-to", {"nargs": "+"})
)
def main(arguments):
    """sensitivity.csv and sensitivity_ratios.csv to a figure each, in the formats that the outputs'
    endings name.
    """
    combinations, ratios = read_csv(arguments.combinations), read_csv(arguments.ratios)
    matches = draw_matches(
        [row for row in combinations if row["slope"] == combinations[0]["slope"]]
    )
    compared = draw_ratios([row for row in ratios if row["rule"] == "exact"])
    for figure, paths in ((matches, arguments.matches_to), (compared, arguments.ratios_to)):
        for path in paths:
            save_figure(figure, path, colours=128)
    return "figure: sensitivity"


if __name__ == "__main__":
    run(main, __doc__)
