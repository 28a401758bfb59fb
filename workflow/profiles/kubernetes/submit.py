"""Give a job's script to Kubernetes, and print the name of the Job that runs it.

python3 submit.py THREADS MEGABYTES MINUTES SCRIPT
"""

import json
import subprocess
import sys
from pathlib import Path

import yaml

TEMPLATE = Path(__file__).with_name("job.yaml")


def job(threads, megabytes, minutes, script):
    """The Job: the template, with its command and what it asks for."""
    asked = yaml.safe_load(TEMPLATE.read_text(encoding="utf-8"))
    pod = asked["spec"]["template"]["spec"]
    pod["activeDeadlineSeconds"] = 60 * int(minutes)
    container = pod["containers"][0]
    container["command"] = ["bash", script]
    memory = {"memory": f"{megabytes}M"}
    container["resources"] = {"requests": {"cpu": threads, **memory}, "limits": memory}
    return asked


if __name__ == "__main__":
    create = ["kubectl", "create", "--filename", "-", "--output", "name"]
    told = json.dumps(job(*sys.argv[1:]))
    sys.exit(subprocess.run(create, input=told, text=True, check=False).returncode)
