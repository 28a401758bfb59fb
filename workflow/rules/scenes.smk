# Scenes: read and checked before any job starts; each job reads what was validated, scene.json.


rule scene:
    input:
        library("check"),
        file="config/scenes/{scene}.yaml",
    output:
        "results/{scene}/scene.json",
    log:
        "results/{scene}/logs/scene.log",
    priority: 20
    params:
        content=content("check", lambda wildcards: [f"config/scenes/{wildcards.scene}.yaml"]),
    shell:
        "python3 -m signorini check {input.file:q} --document-only -o {output:q} 2>&1 | tee {log:q}"
