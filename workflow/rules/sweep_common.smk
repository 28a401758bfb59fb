# What the rules of a sweep ask of a scene.
from signorini.scene.sweep import UNSWEPT, sweep_points
from signorini.sweeps.bundles import bundles, numbered


def sweep_of(name):
    """The section of a scene; its points are only made where a sweep is asked for."""
    section = scene(name).document.get("sweep")
    if section is None:
        raise SignoriniError(f"config/scenes/{name}.yaml: there is no section sweep; add one")
    return section


@cache
@reported
def bundle_count(name):
    """Jobs that the points of a scene's sweep are bundled into."""
    asked = CONFIG["sweep_jobs"]
    return len(bundles(sweep_of(name), None if asked == "auto" else asked))


@cache
def bundles_of(name, count):
    """The points of a scene's sweep in so many bundles, which are made once and not for each job."""
    return bundles(sweep_of(name), count)


def bundle_files(wildcards):
    count = bundle_count(wildcards.scene)
    folder = f"results/{wildcards.scene}/sweep"
    return [f"{folder}/bundle-{number}-of-{count}.json" for number in range(1, count + 1)]


@reported
def bundle_points(wildcards):
    """A parameter: the values of a bundle's points."""
    points = numbered(bundles_of(wildcards.scene, int(wildcards.of)), int(wildcards.bundle))
    return as_json([point.values for point in points])


def swept_parts(wildcards):
    """A parameter: the parts of a scene from which its points start."""
    document = scene(wildcards.scene).document
    return as_json({key: part for key, part in document.items() if key not in UNSWEPT})


@cache
@reported
def mesh_files_of(name):
    """The mesh files of all points of a sweep, which sweeps of anything else share."""
    asked = scene(name)
    if not any(key.split(".")[0] == "domain" for key in sweep_of(name)):
        domains = [asked.document["domain"]]
    else:
        points = sweep_points(sweep_of(name))
        domains = [scene_of_point(asked, point).document["domain"] for point in points]
    files = dict.fromkeys(domain["file"] for domain in domains if domain["kind"] == "mesh")
    return [str(path) for file in files for path in files_read(file)]


def scene_sources(wildcards):
    return mesh_files_of(wildcards.scene)


def sweep_output(name):
    """What the sweep of a scene comes to."""
    if "sweep" not in scene(name).document:
        return []
    tables = ("sweep.csv", "sweep.tex", "sweep_summary.csv", "sweep_summary.md")
    return [f"results/{name}/{file}" for file in (*tables, "sweep.pdf", "sweep.png")]


@cache
@reported
def forecast_of(name, count):
    """What the jobs of a scene's sweep take, the bundles first; only a sweep loads what tells it."""
    from signorini.sweeps.forecast import sweep_jobs

    return sweep_jobs(scene(name), count)


def sweep_seconds(name):
    """Of processor time, in all."""
    return sum(job.seconds for job in forecast_of(name, bundle_count(name)))


def tell_sweeps(names):
    """Say how much work the sweeps are, before any starts."""
    for name in names:
        if "sweep" in scene(name).document:
            count = len(sweep_points(sweep_of(name)))
            told = f"sweep of {name}: {count} points, bundled into jobs: {bundle_count(name)}"
            seconds = f"about {sweep_seconds(name):.1f} s of processor time where all is to solve"
            print(f"{told}, {seconds}", file=sys.stderr)
