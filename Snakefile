# Entry point: `snakemake --cores 2`. The workflow itself is in workflow/.
include: "workflow/Snakefile"


# An included file cannot set the default target.
rule default:
    """The same as all."""
    default_target: True
    input:
        rules.all.input,
