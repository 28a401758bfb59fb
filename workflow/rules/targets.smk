# What is built: by the scenes that the configuration asks for, and of each what it asks for itself.


def scene_output(name):
    """What one scene asks for; what it does not ask for never enters the job graph."""
    asked = scene(name)
    outputs, paper = asked.document["outputs"], name == "paper"
    files = [f"{output}.csv" for output in ("errors", "rates") if output in outputs]
    files += ["table_5_1.tex" if paper else "table.tex"] if "table" in outputs else []
    files += ["expect.txt"] if "expect" in asked.document else []
    files += [f"vtu/{element}.vtu" for element in asked.elements] if "vtu" in outputs else []
    if "figures" in outputs:
        files += (
            [f"{figure}.{ending}" for figure in FIGURES for ending in ("pdf", "png")]
            if paper
            else ["figures"]
        )
    return solutions(name) + [f"results/{name}/{file}" for file in files]


def all_scenes():
    return [file for name in known_scenes() for file in scene_output(name)]


def final_output():
    return [file for name in CONFIG["scenes"] for file in scene_output(name)] + paper_output()
