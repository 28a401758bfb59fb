# Figures: first the numbers that a figure shows, then the drawing.


rule surface:
    input:
        library("surface"),
        mesh=mesh_file,
        reference="results/{scene}/reference.npz",
    output:
        "results/{scene}/surface.npz",
    log:
        "results/{scene}/logs/surface.log",
    benchmark:
        "results/{scene}/benchmarks/surface.tsv"
    params:
        content=content("surface"),
    shell:
        "python3 -m signorini surface {input.mesh:q} {input.reference:q} -o {output:q} 2>&1 | tee {log:q}"


rule figure_surface:
    input:
        library("draw-surface"),
        surface="results/{scene}/surface.npz",
    output:
        pdf="results/{scene}/surface.pdf",
        png=report(
            "results/{scene}/surface.png",
            caption="../report/surface.rst",
            category="{scene}",
            labels={"shows": "3 reference solution"},
        ),
    log:
        "results/{scene}/logs/figure_surface.log",
    params:
        content=content("draw-surface"),
    shell:
        "python3 -m signorini draw-surface {input.surface:q} -o {output:q} 2>&1 | tee {log:q}"


rule field:
    input:
        library("field"),
        mesh=mesh_file,
        solution=finest,
    output:
        "results/{scene}/field.npz",
    log:
        "results/{scene}/logs/field.log",
    benchmark:
        "results/{scene}/benchmarks/field.tsv"
    params:
        content=content("field"),
    shell:
        "python3 -m signorini field {input.mesh:q} {input.solution:q} -o {output:q} 2>&1 | tee {log:q}"


rule contact_line:
    input:
        library("contact-line"),
        scene=ancient(exact_scene_file),
        mesh=mesh_file,
        solutions=finest_of_each,
        reference=line_reference,
    output:
        "results/{scene}/contact_line.csv",
    log:
        "results/{scene}/logs/contact_line.log",
    benchmark:
        "results/{scene}/benchmarks/contact_line.tsv"
    params:
        content=content("contact-line"),
        truth=exact_statement,
        exact=exact_option,
        reference=reference_option,
    shell:
        "python3 -m signorini contact-line {input.mesh:q} {input.solutions:q} {params.exact}"
        " {params.reference} -o {output:q} 2>&1 | tee {log:q}"


# All figures of a scene at once: importing Matplotlib takes longer than drawing them.
rule figures:
    input:
        library("figures"),
        unpack(shown),
        scene=ancient(scene_file),
    output:
        report(
            directory("results/{scene}/figures"),
            patterns=["{figure}.png"],
            caption="../report/figures.rst",
            category="{scene}",
            labels={"shows": "3 figure: {figure}"},
        ),
    log:
        "results/{scene}/logs/figures.log",
    params:
        content=content("figures"),
        asked=parts("title", "elements", "levels", "norms", "slope"),
        options=figure_options,
        note=reference_note,
    shell:
        "python3 -m signorini figures {input.scene:q} {params.options} -o {output:q} 2>&1 | tee {log:q}"


# What is local: errors, jumps and parts of bounds, triangle by triangle, of the finest level.
rule details:
    input:
        library("details"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        reference=reference_file,
        certificate=certificate_if_any,
        solutions=finest_of_each,
    output:
        "results/{scene}/details.npz",
    log:
        "results/{scene}/logs/details.log",
    benchmark:
        "results/{scene}/benchmarks/details.tsv"
    params:
        content=content("details"),
        statement=statement,
        reference=reference_option,
        certificate=details_certificate,
    shell:
        "python3 -m signorini details {input.scene:q} {input.solutions:q} --mesh {input.mesh:q}"
        " {params.reference} {params.certificate} -o {output:q} 2>&1 | tee {log:q}"


rule figures_of_details:
    input:
        library("draw-details"),
        details="results/{scene}/details.npz",
    output:
        report(
            directory("results/{scene}/details"),
            patterns=["{figure}.png"],
            caption="../report/details.rst",
            category="{scene}",
            labels={"shows": "5 details: {figure}"},
        ),
    log:
        "results/{scene}/logs/figures_of_details.log",
    params:
        content=content("draw-details"),
    shell:
        "python3 -m signorini draw-details {input.details:q} -o {output:q} 2>&1 | tee {log:q}"


rule gallery:
    """A contact sheet of the solutions of all scenes."""
    input:
        library("gallery"),
        scenes=ancient(lambda wildcards: [validated_file(name) for name in known_scenes()]),
        fields=expand("results/{scene}/field.npz", scene=known_scenes()),
    output:
        report(
            "results/gallery.png",
            caption="../report/gallery.rst",
            category="all scenes",
            labels={"shows": "solutions of all scenes"},
        ),
    log:
        "results/logs/gallery.log",
    params:
        content=content("gallery"),
        titles=lambda wildcards: as_json([scene(name).document["title"] for name in known_scenes()]),
    shell:
        "python3 -m signorini gallery --scenes {input.scenes:q} --fields {input.fields:q}"
        " -o {output:q} 2>&1 | tee {log:q}"


rule gallery_page:
    """All that is built of all scenes on one page; each of the viewers is about 5 MB."""
    input:
        library("gallery-page"),
        scenes=ancient(lambda wildcards: [validated_file(name) for name in known_scenes()]),
        fields=expand("results/{scene}/field.npz", scene=known_scenes()),
        viewers=expand("results/{scene}/viewer.html", scene=known_scenes()),
        built=lambda wildcards: all_scenes(),
    output:
        "results/gallery.html",
    log:
        "results/logs/gallery_page.log",
    params:
        content=content("gallery-page"),
        asked=lambda wildcards: as_json(
            [
                scene(name).section("title", "elements", "levels", "slope")
                for name in known_scenes()
            ]
        ),
    shell:
        "python3 -m signorini gallery-page {input.scenes:q} --results results"
        " -o {output:q} 2>&1 | tee {log:q}"


rule viewer:
    input:
        library("viewer"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        solutions=solution_files,
        tables=viewer_tables,
        certificates=certificates_if_any,
    output:
        report(
            "results/{scene}/viewer.html",
            caption="../report/viewer.rst",
            category="{scene}",
            labels={"shows": "4 solutions to turn"},
        ),
    log:
        "results/{scene}/logs/viewer.log",
    params:
        content=content("viewer"),
        asked=parts("title", "elements", "levels", "norms"),
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini viewer {input.scene:q} --results {params.folder:q}"
        " --mesh {input.mesh:q} -o {output:q} 2>&1 | tee {log:q}"


rule vtu:
    input:
        library("vtu"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        solution=lambda wildcards: finest(wildcards, wildcards.element),
        certificates=certificate_if_any,
    output:
        "results/{scene}/vtu/{element}.vtu",
    log:
        "results/{scene}/logs/vtu_{element}.log",
    benchmark:
        "results/{scene}/benchmarks/vtu_{element}.tsv"
    params:
        content=content("vtu"),
        coefficient=coefficient,
        certificates=certificate_option,
    shell:
        "python3 -m signorini vtu {input.mesh:q} {input.solution:q} --scene {input.scene:q}"
        " {params.certificates} -o {output:q} 2>&1 | tee {log:q}"


# All levels, for ParaView to play.
rule vtu_series:
    input:
        library("vtu"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        solutions=levels_of_element,
        certificates=certificates_if_any,
    output:
        series="results/{scene}/vtu/{element}.pvd",
        files=directory("results/{scene}/vtu/{element}"),
    log:
        "results/{scene}/logs/vtu_series_{element}.log",
    benchmark:
        "results/{scene}/benchmarks/vtu_series_{element}.tsv"
    params:
        content=content("vtu"),
        coefficient=coefficient,
        certificates=certificate_option,
    shell:
        "python3 -m signorini vtu {input.mesh:q} {input.solutions:q} --scene {input.scene:q}"
        " {params.certificates} -o {output.series:q} 2>&1 | tee {log:q}"
