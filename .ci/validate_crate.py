"""Hold an RO-Crate against the profile Provenance Run Crate and all that it inherits, without a
network: exit status 1 if a requirement is not met.

    VALIDATOR/bin/python .ci/validate_crate.py CRATE

That Python is one with roc-validator, in an environment of its own. The validator asks the network
for what the terms of a crate mean; here crate_terms.json answers, the address of each context with
those of its terms that our crates use. A term that is not there is not met, as it would be there.
"""

import argparse
import io
import json
import sys
import tempfile
from collections import Counter
from pathlib import Path

from requests.adapters import HTTPAdapter
from requests_cache import CachedSession
from rocrate_validator.models import Severity, ValidationSettings
from rocrate_validator.services import validate
from urllib3 import HTTPResponse

PROFILE = "provenance-run-crate-0.5"
TERMS = Path(__file__).with_name("crate_terms.json")


class Kept(HTTPAdapter):
    """Answers from a dictionary, in place of a network."""

    def __init__(self, contexts):
        super().__init__()
        self.contexts = contexts

    def send(self, request, **options):
        """The context of that address."""
        body = io.BytesIO(json.dumps({"@context": self.contexts[request.url]}).encode())
        told = {"status": 200, "request_url": request.url, "preload_content": False}
        answer = HTTPResponse(body, {"Content-Type": "application/ld+json"}, **told)
        return self.build_response(request, answer)


def fill_cache(path, contexts):
    """Put contexts where the validator looks before it asks the network."""
    with CachedSession(str(path), backend="sqlite", expire_after=-1) as session:
        session.mount("https://", Kept(contexts))
        for address in contexts:
            session.get(address)


def issues_of(crate, contexts):
    """What is not met, of requirements and of recommendations."""
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder, "contexts")
        fill_cache(cache, contexts)
        settings = ValidationSettings(
            rocrate_uri=str(crate),
            profile_identifier=PROFILE,
            requirement_severity=Severity.RECOMMENDED,
            offline=True,
            cache_path=str(cache),
        )
        return validate(settings).get_issues(Severity.RECOMMENDED)


def main():
    """Print each kind of issue with its count, and the verdict."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("crate", metavar="CRATE")
    crate = parser.parse_args().crate
    issues = issues_of(crate, json.loads(TERMS.read_text(encoding="utf-8")))
    kinds = Counter((issue.severity, issue.check.identifier, issue.message) for issue in issues)
    for (severity, check, message), count in sorted(kinds.items()):
        print(f"{severity.name} {check}, {count} times: {message}")
    unmet = [issue for issue in issues if issue.severity >= Severity.REQUIRED]
    print(f"{crate}: {PROFILE}: {'NOT met' if unmet else 'met'}")
    return bool(unmet)


if __name__ == "__main__":
    sys.exit(main())
