"""Licences of all that a package of the workspace is linked from: names, then each text once.

Needs the target and the package: x86_64-unknown-linux-musl percoat.
"""

import json
import subprocess
import sys
from pathlib import Path

LICENCE_FILES = ("licenses/*", "LICENSE*", "LICENCE*", "license*", "COPYING*", "COPYRIGHT*", "NOTICE*", "UNLICENSE*")


def linked(target, package):
    """Packages that a package is linked from on a target, by name: no procedural macros, nothing that only builds or tests need."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", target]
    graph = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    packages = {package["id"]: package for package in graph["packages"]}
    nodes = {node["id"]: node for node in graph["resolve"]["nodes"]}
    root = next(one["id"] for one in graph["packages"] if one["name"] == package and one["source"] is None)
    found, left = set(), [root]
    while left:
        key = left.pop()
        is_macro = any("proc-macro" in part["kind"] for part in packages[key]["targets"])
        if key in found or is_macro:
            continue
        found.add(key)
        for edge in nodes[key]["deps"]:
            if any(kind["kind"] is None for kind in edge["dep_kinds"]):
                left.append(edge["pkg"])
    found.remove(root)
    return sorted((packages[key] for key in found), key=lambda package: (package["name"], package["version"]))


def texts(folder):
    """Texts of the licences in a package, also of what it brings with it."""
    files = {file for pattern in LICENCE_FILES for file in folder.rglob(pattern) if file.is_file()}
    return [file.read_text(encoding="utf-8", errors="replace").strip() for file in sorted(files)]


target, package = sys.argv[1:]
packages = [one for one in linked(target, package) if one["name"] != "percoat"]
owners = {}
libraries = "the Rust standard library (MIT OR Apache-2.0)" + (" and musl (MIT)" if target.endswith("-musl") else "")
print(f"percoat is linked from these packages and from {libraries};")
print("its pictures have letters of DejaVu Sans. Each text of a licence stands below once.\n")
for package in packages:
    name = f"{package['name']} {package['version']}"
    print(f"- {name}: {package['license']}, {package['repository'] or ''}".rstrip(", "))
    for text in texts(Path(package["manifest_path"]).parent):
        owners.setdefault(text, []).append(name)
for text in texts(Path("crates/draw/src/font")):
    owners.setdefault(text, []).append("DejaVu Sans")
for text, names in owners.items():
    print(f"\n{'=' * 100}\n{', '.join(dict.fromkeys(names))}\n\n{text}")
