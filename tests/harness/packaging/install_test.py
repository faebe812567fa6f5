#!/usr/bin/env python3
"""Installs a build, moves it, hides the source tree, and runs the main commands from another folder.

usage: install_test.py CMAKE BUILD SOURCE VERSION

Root hides the source tree and the build behind empty folders, in a mount namespace of the command alone. Others look whether
the program names them.
"""
import json
import os
import subprocess
import sys
import tempfile

cmake, build, source, version = sys.argv[1:]
failures = []
PAIR = ('{"id": "p", "a": {"shape": {"type": "box", "half_extents": [1, 1, 1]}}, '
        '"b": {"shape": {"type": "sphere", "radius": 1}, "translation": [1.9, 0, 0]}}\n')


def expect(holds, what):
    if not holds:
        failures.append(what)
        print("FAIL:", what)


def hide():
    """Returns the words before a command that is not to see the source tree."""
    words = ["unshare", "-m", "sh", "-c", f"mount -t tmpfs none '{source}' && exec \"$@\"", "sh"]
    seen = subprocess.run([*words, "test", "-e", os.path.join(source, "CMakeLists.txt")], capture_output=True)
    hidden = seen.returncode == 1 and not seen.stderr
    return words if hidden else []


class Installed:
    def __init__(self, prefix, home):
        self.program = os.path.join(prefix, "bin/touchstone")
        self.data = os.path.join(prefix, "share/touchstone")
        self.home = home
        self.hidden = hide()

    def run(self, line, status=0, holds=()):
        """Runs a command in the home folder. Its output must have these texts, and no path of the source tree."""
        ran = subprocess.run([*self.hidden, self.program, *line.split()], cwd=self.home, capture_output=True, text=True,
                             env={"PATH": "/usr/bin:/bin", "HOME": self.home})
        text = ran.stdout + ran.stderr
        expect(ran.returncode == status, f"`{line}` ended with {ran.returncode}, not {status}:\n{text[-2000:]}")
        for part in holds:
            expect(part in text, f"`{line}` says nothing of '{part}':\n{text[-2000:]}")
        expect(source + "/" not in text, f"`{line}` names the source tree:\n{text[-2000:]}")

    def has(self, name):
        expect(os.path.exists(os.path.join(self.home, name)), f"{name} was not written")


def check_files(prefix):
    for name in ("lib/touchstone", "share/bash-completion/completions/touchstone", "share/doc/touchstone/copyright",
                 "share/doc/touchstone/changelog.gz", "share/touchstone/harness/shards/slurm.sh",
                 "share/touchstone/datasets/adapters/rapier/peer.toml", "share/touchstone/plots/plot.py",
                 "share/touchstone/results/method.md", "share/touchstone/datasets/corpus/2026/cases.jsonl.zst"):
        expect(os.path.exists(os.path.join(prefix, name)), f"{name} is not installed")
    made = os.path.exists(os.path.join(build, "harness/packaging/man/touchstone.1.gz"))
    for page in ("touchstone", "touchstone-query", "touchstone-scene-draw") if made else ():
        file = os.path.join(prefix, f"share/man/man1/{page}.1.gz")
        expect(os.path.exists(file), f"the manual has no {page}")
    for folder, folders, files in os.walk(prefix):
        for name in folders + files:
            expect(name not in ("local", "node_modules", "__pycache__", "CMakeLists.txt"), f"{folder}/{name} is installed")
    with open(os.path.join(prefix, "bin/touchstone"), "rb") as file:
        expect(source.encode() + b"/" not in file.read(), "the program names the source tree")


def check_bill(prefix):
    """The bill of materials names what the program loads, and a licence of each."""
    with open(os.path.join(prefix, "share/doc/touchstone/touchstone.spdx.json"), encoding="utf-8") as file:
        bill = json.load(file)
    expect(bill["spdxVersion"] == "SPDX-2.3" and version in bill["name"], f"the bill of materials is of {bill['name']}")
    ids = {package["SPDXID"] for package in bill["packages"]} | {bill["SPDXID"]}
    for relationship in bill["relationships"]:
        expect({relationship["spdxElementId"], relationship["relatedSpdxElement"]} <= ids, f"of nothing: {relationship}")
    kinds = {relationship["relationshipType"] for relationship in bill["relationships"]}
    expect(kinds == {"DESCRIBES", "DYNAMIC_LINK", "CONTAINS"}, f"the bill of materials has {kinds} alone")
    for package in bill["packages"]:
        expect(package["licenseDeclared"] != "NOASSERTION", f"{package['name']} has no licence in harness/packaging/packages.csv")


def complete(program, words):
    """Returns what the shell offers behind these words."""
    script = os.path.join(os.path.dirname(program), "../share/bash-completion/completions/touchstone")
    line = " ".join(["touchstone", *words])
    text = f"""source /usr/share/bash-completion/bash_completion; source '{script}'
      PATH='{os.path.dirname(program)}':$PATH
      COMP_WORDS=({line}) COMP_CWORD={len(words)} COMP_LINE='{line}' COMP_POINT={len(line)}
      _touchstone touchstone; printf '%s\\n' "${{COMPREPLY[@]}}" """
    return subprocess.run(["bash", "-c", text], capture_output=True, text=True).stdout.split()


def check_completion(program):
    if not os.path.exists("/usr/share/bash-completion/bash_completion"):
        print("bash-completion is not installed: completion is not tried")
        return
    for words, offered in (("re", ["reproduce", "report"]), ("scene d", ["draw", "describe"]), ("--isa b", ["baseline", "best"]),
                           ("check --save", ["--save-certificates"])):
        found = complete(program, words.split())
        expect(found == offered, f"`touchstone {words}` is completed by {found}, not {offered}")


def check_commands(installed):
    with open(os.path.join(installed.home, "pair.jsonl"), "w", encoding="utf-8") as file:
        file.write(PAIR)
    with open(os.path.join(installed.home, "bad.jsonl"), "w", encoding="utf-8") as file:
        file.write('{"id": "p", "a": 3}\n')
    run = installed.run
    run("--version", holds=[f"touchstone {version}"])
    run("--help", holds=["query", "reproduce"])
    run("", status=2)
    for word in ("setup", "test", "bench"):
        run(word, status=2, holds=[f"`{word}` needs the source tree"])
    run("list", holds=["certified"])
    run("query pair.jsonl", holds=["exact"])
    run("query none.jsonl", status=2, holds=["none.jsonl"])
    run("query bad.jsonl", status=2, holds=["bad.jsonl:1"])
    run("query datasets/defects/fcl_naive.jsonl --with exact --out defects.csv")
    run("check pair.jsonl --with certified --out checked", holds=["checked"])
    run("check pair.jsonl --save-certificates proof.jsonl", holds=["proof.jsonl"])
    run("check --certificates proof.jsonl", holds=["1"])
    run("scene describe datasets/rock_pile.toml", holds=["bodies"])
    with open(os.path.join(installed.home, "bad.glb"), "w", encoding="utf-8") as file:
        file.write("no model")
    run("scene describe bad.glb", status=2, holds=["bad.glb: ", "Assimp"])
    run("robot datasets/robots/arm.urdf --random 20 --out arm", holds=["arm/pairs.csv"])
    run("run datasets/campaigns/reference.toml --dry-run")
    run("run --scene datasets/shapes.toml --frames 2 --seconds 0.01 --broad naive --narrow certified --task intersect",
        holds=["results/local/command-line"])
    installed.has("results/local/command-line/raw.csv")
    installed.has("results/local/command-line/machine.csv")
    run("show results/local/command-line")
    run("show --tables results/reference --out tables")
    installed.has("tables/tables.md")
    run("--peer x list", status=2)
    if os.path.exists(os.path.join(installed.data, "page.html")):
        run("report results/local/command-line --out page.html", holds=["page.html"])
    else:
        run("report results/local/command-line --out page.html", status=2, holds=["page.html: the page is not installed"])


def main():
    # Not below the source tree, which is hidden.
    with tempfile.TemporaryDirectory(prefix="touchstone-install-") as folder:
        first, prefix, home = (os.path.join(folder, name) for name in ("first", "moved here", "home"))
        os.mkdir(home)
        subprocess.run([cmake, "--install", build, "--prefix", first, "--component", "program", "--strip"], check=True,
                       stdout=subprocess.DEVNULL)
        os.rename(first, prefix)
        check_files(prefix)
        check_bill(prefix)
        installed = Installed(prefix, home)
        print("the source tree is hidden" if installed.hidden else "the source tree cannot be hidden here")
        check_commands(installed)
        check_completion(installed.program)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
