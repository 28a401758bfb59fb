"""Print what has become of a Job of Kubernetes: running, success or failed.

python3 status.py NAME
"""

import json
import subprocess
import sys


def state(found):
    """Of a Job as Kubernetes describes it, or of none, which somebody has deleted."""
    if not found:
        return "failed"
    status = json.loads(found).get("status", {})
    if status.get("failed"):
        return "failed"
    return "success" if status.get("succeeded") else "running"


if __name__ == "__main__":
    get = ["kubectl", "get", "--ignore-not-found", "--output", "json", sys.argv[1]]
    answer = subprocess.run(get, stdout=subprocess.PIPE, text=True, check=False)
    # Where Kubernetes does not answer, nothing is known of the job; Snakemake will ask again.
    print("running" if answer.returncode else state(answer.stdout.strip()))
