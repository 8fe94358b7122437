# SPDX-License-Identifier: Apache-2.0
"""Which shaders the program declares, and their parameters as rows of a table."""
import json
import re
import subprocess

HEAD = ["| parameter | type | default | range, unit | meaning |", "|---|---|---|---|---|"]


def declared(oriel):
    """All shaders by name, those of other programs as well."""
    run = subprocess.run([str(oriel), "shaders", "--json"], capture_output=True, text=True,
                         check=True)
    specs = [json.loads(line) for line in run.stdout.splitlines() if line]
    return {spec["name"]: spec for spec in specs}


def cell(text):
    return str(text).replace("|", "\\|")


def parameter_rows(spec, but=()):
    """A table's rows; numbered neighbours that say the same share one."""
    rows = []
    for p in spec["parameters"]:
        if p["name"] in but:
            continue
        facts = [p["type"], p.get("default", ""), "", p.get("doc", "")]
        low, high = p.get("min"), p.get("max")
        if low is not None and high is not None:
            facts[2] = f"{low:g} ... {high:g}"
        elif low is not None or high is not None:
            facts[2] = f">= {low:g}" if high is None else f"<= {high:g}"
        if p.get("unit"):
            facts[2] = (facts[2] + ", " if facts[2] else "") + p["unit"]
        if p.get("alias"):
            facts[3] += f" Also written `{p['alias']}`."
        if p["support"] != "exact":
            facts[3] += f" *{p['support'].capitalize()}.*"
        numbered = re.fullmatch(r"(\w*_)(\d+)", p["name"])
        stem = numbered[1] if numbered else None
        if rows and stem and rows[-1]["stem"] == stem and rows[-1]["facts"] == facts:
            rows[-1]["last"] = p["name"]
        else:
            rows.append({"first": p["name"], "last": None, "stem": stem, "facts": facts})
    return ["| " + " | ".join([f"`{r['first']}`" + (f" ... `{r['last']}`" if r["last"] else ""),
                               *map(cell, r["facts"])]) + " |" for r in rows]
