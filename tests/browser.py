"""Pages as a browser shows them: Chromium without a window, which tells what became of a page."""

import html
import json
import re
import shutil
import subprocess

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")
MISSING = "no Chromium here; on Debian: apt-get install chromium"
OPTIONS = (
    *("--headless", "--no-sandbox", "--disable-gpu"),
    *("--use-angle=swiftshader", "--enable-unsafe-swiftshader"),  # WebGL in software
    "--host-resolver-rules=MAP * ~NOTFOUND",  # no network, whatever a page asks for
    "--virtual-time-budget=60000",
    "--dump-dom",
)
# Before any script of the page: what goes wrong, and what is asked for elsewhere.
WATCH = """<script>
const told = {wrong: [], steps: []};
for (const level of ["error", "warn"]) console[level] = (...words) => told.wrong.push(words.join());
addEventListener("error", (event) => told.wrong.push(String(event.message)), true);
addEventListener("unhandledrejection", (event) => told.wrong.push(String(event.reason)));
addEventListener("securitypolicyviolation", (event) => told.wrong.push(event.blockedURI));
const until = async (test) => {
  while (!test()) await new Promise((resolve) => setTimeout(resolve, 20));
};
</script>
"""
# After all of them.
TELL = """<script>
(async () => {{
{steps}
  told.requests = performance.getEntriesByType("resource").map((entry) => entry.name);
  const note = document.createElement("pre");
  note.id = "told";
  note.textContent = JSON.stringify(told);
  document.body.append(note);
}})();
</script>
</body>"""


def told_by(page, folder, steps, size=(1200, 900)):
    """Open a page, take steps in it, and return what it tells.

    Parameters
    ----------
    page : str
        HTML.
    folder : Path
        Of this page alone.
    steps : str
        JavaScript in an asynchronous function; it may push to ``told.steps`` and wait with
        ``await until(() => ...)``.
    size : (int, int)
        Of the window.

    Returns
    -------
    dict
        ``wrong``, ``requests``, and ``steps``.
    """
    path = folder / "page.html"
    page = page.replace("<head>", f"<head>{WATCH}", 1)
    start, end = page.rsplit("</body>", 1)
    path.write_text(start + TELL.format(steps=steps) + end, encoding="utf-8")
    options = [*OPTIONS, f"--window-size={size[0]},{size[1]}", f"--user-data-dir={folder}/profile"]
    command = [CHROMIUM, *options, path.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    found = re.search(r'<pre id="told">(.*?)</pre>', done.stdout, re.S)
    assert found, done.stderr[-2000:]
    return json.loads(html.unescape(found.group(1)))
