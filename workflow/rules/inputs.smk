# Scenes, read and checked before any job starts, and what the jobs of a scene depend on.

from signorini.mesh.boundary import labels_of
from signorini.mesh.files import files_read
from signorini.publication.check import check_publication
from signorini.scene.certified import is_certifiable, is_certified
from signorini.scene.file_names import check_name
from signorini.scene.read import check_points, read_scene, scene_of_point
from signorini.scene.validated import keep_validated
from signorini.wording import listed


@cache
@reported
def scene(name):
    asked = written(name)
    if asked.problem_statement.needs_mesh:
        check_once(asked)
    check_publication(asked)
    if asked.written:
        check_sweep_once(asked)
    return asked


@cache
@reported
def written(name):
    """A scene of which only its file has been read."""
    check_name(name)
    path = Path("config/scenes", f"{name}.yaml")
    if not path.is_file():
        raise SignoriniError(f"{where_named(name)}: {missing_scene(name, path)}")
    found = read_scene(path)
    for line in found.warnings:
        print(f"warning: {path}: {line}", file=sys.stderr)
    return found


def where_named(name):
    """The place that asks for a scene, for messages: a key of the configuration, or a target."""
    if name in CONFIG["scenes"]:
        return f"{where_asked('scenes')}: scenes"
    is_studied = name == CONFIG.get("studied")
    return f"{where_asked('studied')}: studied" if is_studied else f"results/{name}"


def missing_scene(name, path):
    """What to say of a scene whose file is not there: where it is, or what else there is."""
    if os.path.lexists(path):
        return f"{path} is a folder or a link to nothing; put the scene's file there"
    elsewhere = sorted(filter(Path.is_file, Path("config/scenes").rglob(f"{name}.y*ml")))
    if elsewhere:
        return f"there is no {path}, but {elsewhere[0]}; move it there"
    return f"there is no {path}; {nearest(name, known_scenes())}"


def check_once(asked):
    """Check what takes numpy and a mesh, and remember by a file that this scene has passed this library's checks."""
    domain = asked.document["domain"]
    files = files_read(domain["file"]) if domain["kind"] == "mesh" else []
    seen = as_json([asked.statement, digest(files), digest_of_checks()])
    once(seen, asked.check)


def check_sweep_once(asked):
    """The same for the scenes of all points of a sweep."""
    seen = as_json([asked.written, digest(modules_from("signorini.scene.read", reader=True))])
    once(seen, lambda: check_points(asked))


def once(seen, check):
    """Call a check, unless it has passed what it saw."""
    mark = Path(".snakemake/checked", hashlib.sha256(seen.encode()).hexdigest())
    if mark.is_file():
        return
    check()
    with suppress(OSError):  # it will be checked again
        mark.parent.mkdir(parents=True, exist_ok=True)
        mark.touch()


@cache
def digest_of_checks():
    """What is in the files that check a scene."""
    return digest(modules_from("signorini.scene.statement"))


def known_scenes():
    return sorted(path.stem for path in Path("config/scenes").glob("*.yaml"))


def scene_file(wildcards):
    """The validated scene, an input that starts no job: params hold the parts on which a job depends."""
    return validated_file(wildcards.scene)


@cache
@reported
def validated_file(name):
    """The file of a validated scene, which is brought up to date here.

    Not by a rule: where another job of the same run writes an input that is ancient, Snakemake looks at no other reason
    to run a job, such as params that changed.
    """
    path = f"results/{name}/scene.json"
    keep_validated(path, scene(name))
    return path


def statement(wildcards):
    """What a discretisation depends on, as JSON: it reruns when this changes and only then."""
    return statement_of(wildcards.scene)


def statement_of(name):
    return as_json(scene(name).statement)


def check_memory(jobs):
    """Refuse to start where a job could not hold its level; on a cluster each job says so itself."""
    from signorini.scene.memory_check import check_level

    for job in jobs:
        if job.rule.name in ("solve", "reference"):
            name, n = job.wildcards.scene, int(job.params.get("n") or job.wildcards.n)
            element = job.params.get("element") or job.wildcards.element
            try:
                check_level(scene(name).problem_statement, element, n, job.params.method)
            except SignoriniError as error:
                sys.exit(f"error: config/scenes/{name}.yaml: {error}")


def parts(*keys):
    """A parameter: the parts of a scene on which a job depends; it runs again when they change and only then."""
    return lambda wildcards: as_json(scene(wildcards.scene).section(*keys))


def reference_note(wildcards):
    """What a table says of a reference that is hardly finer than the finest level; empty where it is fine enough."""
    return scene(wildcards.scene).reference_note or ""


def domain_of(name):
    asked = written(name)
    return asked.section("domain", "boundary") | {"coarsest": asked.levels[0]}


@cache
def mesh_key(name):
    """Scenes with the same domain, boundary and coarsest level have the same mesh."""
    return hashlib.sha256(as_json(domain_of(name)).encode()).hexdigest()[:12]


@cache
@reported
def scene_of_mesh(key):
    """Of the scenes asked for first, so that a broken file elsewhere in config/scenes does no harm."""
    keys = {}
    for name in dict.fromkeys([*CONFIG["scenes"], *known_scenes()]):
        keys.setdefault(mesh_key(name), name)
        if key in keys:
            return keys[key]
    of_scenes = listed(f"{known} of {name}" for known, name in keys.items())
    raise SignoriniError(f"results/meshes/{key}.npz: the mesh of no scene; known: {of_scenes}")


def mesh_source(wildcards):
    """The files that the domain is read from."""
    domain = domain_of(scene_of_mesh(wildcards.mesh))["domain"]
    return list(map(str, files_read(domain["file"]))) if domain["kind"] == "mesh" else []


def mesh_file(wildcards):
    return f"results/meshes/{mesh_key(wildcards.scene)}.npz"


def accuracy(wildcards):
    """How far a scene's problems are solved."""
    return scene(wildcards.scene).document["solver"]["accuracy"]


def method(wildcards):
    """The scene's route."""
    return scene(wildcards.scene).document["solver"]["method"]


def solutions(name):
    asked = scene(name)
    return [
        f"results/{name}/solutions/{element}/n{n}.npz"
        for element in asked.elements
        for n in asked.levels
    ]


def solution_files(wildcards):
    return solutions(wildcards.scene)


def levels_of_element(wildcards):
    of_element = f"results/{wildcards.scene}/solutions/{wildcards.element}/"
    return [file for file in solution_files(wildcards) if file.startswith(of_element)]


def coefficient(wildcards):
    """A parameter: the diffusion coefficient."""
    return as_json(scene(wildcards.scene).document["data"]["coefficient"])


def finest(wildcards, element=None):
    asked = scene(wildcards.scene)
    return f"results/{wildcards.scene}/solutions/{element or asked.elements[0]}/n{asked.levels[-1]}.npz"


def finest_of_each(wildcards):
    return [finest(wildcards, element) for element in scene(wildcards.scene).elements]


def reference_file(wildcards):
    """The truth as an input of the errors: a file where it is a reference, none where it is exact."""
    return [f"results/{wildcards.scene}/reference.npz"] * (
        scene(wildcards.scene).truth["kind"] == "reference"
    )


@reported
def referenced_scene(wildcards):
    """The scene of a reference, which only some have."""
    kind = scene(wildcards.scene).truth["kind"]
    if kind != "reference":
        raise SignoriniError(
            f"results/{wildcards.scene}/reference.npz: the scene has none, its truth.kind is {kind};"
            " surfaces and references are those of scenes with truth.kind reference"
        )
    return scene_file(wildcards)


def truth_part(wildcards):
    """A parameter: what errors depend on besides their files, which is the statement of an exact scene."""
    asked = scene(wildcards.scene)
    return asked.statement if asked.truth["kind"] == "exact" else coefficient_part(asked.document)


def exact_statement(wildcards):
    """A parameter: what an exact truth depends on, where there is one."""
    asked = scene(wildcards.scene)
    return as_json(asked.statement if asked.truth["kind"] == "exact" else None)


def exact_scene_file(wildcards):
    """The scene, where its exact solution is tabulated."""
    exact = scene(wildcards.scene).truth["kind"] == "exact"
    return [scene_file(wildcards)] if exact else []


def line_reference(wildcards):
    """The reference of the contact line, where errors need it anyway."""
    measured = {"errors", "rates"}.intersection(scene(wildcards.scene).document["outputs"])
    return reference_file(wildcards) if measured else []


def exact_option(wildcards, input):
    """Option of the contact line for an exact truth, where there is one."""
    exact = scene(wildcards.scene).truth["kind"] == "exact"
    return f"--scene {quote(str(input.scene))}" if exact else ""


def coefficient_part(document):
    """The diffusion coefficient, where a norm is weighted with it."""
    return document["data"]["coefficient"] if "energy" in document["norms"] else None


def reference_option(wildcards, input):
    """Option of the errors for a reference, where there is one."""
    return f"--reference {quote(str(input.reference))}" if input.reference else ""


def certificate_files(wildcards):
    return [
        f"results/{wildcards.scene}/certificates/n{n}.npz" for n in scene(wildcards.scene).levels
    ]


def certificates_if_any(wildcards):
    return certificate_files(wildcards) if is_certified(scene(wildcards.scene).document) else []


def certificate_if_any(wildcards):
    """Of the finest level."""
    return certificates_if_any(wildcards)[-1:]


def certificate_option(wildcards, input):
    """Option of the VTU files for certificates, where there are any."""
    files = " ".join(quote(str(file)) for file in input.certificates)
    return f"--certificates {files}" if files else ""


def details_certificate(wildcards, input):
    """Option of the details for a certificate, where there is one."""
    return f"--certificate {quote(str(input.certificate))}" if input.certificate else ""


def certifiable_scenes():
    """Every scene of which guaranteed bounds can be had: the triangles fill its body."""
    return [name for name in known_scenes() if is_certifiable(scene(name).document)]


def drawn_norms(document):
    return (
        [norm for norm in document["norms"] if norm in RATED]
        if "rates" in document["outputs"]
        else []
    )


def shown(wildcards):
    """What the figures of a scene show: the field, and as far as there are any the contact line, errors and slopes."""
    document = scene(wildcards.scene).document
    files = {"field": "field.npz"}
    if "contact" in labels_of(document["boundary"]):
        files |= {"line": "contact_line.csv"}
    if drawn_norms(document):
        files |= {"errors": "errors.csv", "rates": "rates.csv"}
    if is_certified(document):
        files |= {"certificates": "certificates.csv"}
    return {name: f"results/{wildcards.scene}/{file}" for name, file in files.items()}


def viewer_tables(wildcards):
    """What the viewer tells beside the solutions."""
    document = scene(wildcards.scene).document
    asked = {"errors": "errors" in document["outputs"], "certificates": is_certified(document)}
    return [f"results/{wildcards.scene}/{name}.csv" for name in asked if asked[name]]


def figure_options(wildcards):
    """Options of the figures for what `shown` lists."""
    return " ".join(f"--{name} {quote(value)}" for name, value in shown(wildcards).items())


def studied():
    """The scene whose table the studies compute in other ways."""
    if "studied" not in CONFIG:
        sys.exit(f"error: {CONFIG_FILE}: studied: missing; name a scene with published numbers")
    return CONFIG["studied"]


def studied_scene(wildcards):
    return validated_file(studied())


def of_studied(*keys):
    """A parameter: parts of the scene that is studied."""
    return lambda wildcards: as_json(scene(studied()).section(*keys))


def studied_statement(wildcards):
    return statement_of(studied())


def studied_published(wildcards):
    return [publication_file(studied(), "published")]
