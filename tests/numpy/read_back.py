"""Read a solved output folder back with NumPy and check it against its summary.

    python read_back.py FOLDER

Prints one line a check; exit code 1 when one fails.
"""

import json
import sys
from pathlib import Path

import numpy as np


def checks(folder):
    """Pairs (what is checked, whether it holds)."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    steps = summary["steps"]
    n1, n2 = steps[0]["points"]
    fields = (len(steps), n1, n2)
    with np.load(folder / "contact.npz", allow_pickle=False) as archive:
        contact = {name: archive[name] for name in archive.files}

    shapes = {
        "a1": (2,), "a2": (2,), "x": (n1, n2), "y": (n1, n2), "owner": (n1, n2),
        "mean_pressure": (len(steps),), "force": (len(steps),), "penetration": (len(steps),),
        "pressure": fields, "displacement": fields, "gap": fields,
    }
    isolated = summary["case"].get("lattice", {}).get("kind") == "isolated"
    if isolated:
        del shapes["mean_pressure"]
    # A material with a hardness.
    if any(step.get("plastic") is not None for step in steps):
        shapes["indentation"] = fields
    yield "arrays are those of the interface", set(contact) == set(shapes)
    for name, shape in shapes.items():
        dtype = np.dtype("<i4" if name == "owner" else "<f8")
        yield f"{name} has shape {shape} and type {dtype}", contact[name].shape == shape and contact[name].dtype == dtype
    yield "every number is finite", all(np.isfinite(array).all() for array in contact.values())

    p, w, g = (contact[name] for name in ("pressure", "displacement", "gap"))
    force, penetration = contact["force"], contact["penetration"]
    (a1x, a1y), (a2x, a2y) = contact["a1"], contact["a2"]
    mean = p.mean(axis=(1, 2))
    ((kind, asked),) = summary["case"]["load"].items()
    found = {"mean_pressure": mean, "force": mean * abs(a1x * a2y - a1y * a2x)}
    yield "pressures carry the load asked for", np.allclose(found[kind], asked, rtol=1e-12, atol=0)
    yield "pressures carry the force", np.allclose(found["force"], force, rtol=1e-12, atol=0)
    scalars = ("force", "penetration") if isolated else ("mean_pressure", "force", "penetration")
    yield "scalars are those of the summary", all(
        contact[name].tolist() == [step[name] for step in steps] for name in scalars
    )
    yield "pressure is nowhere negative", (p >= 0).all()
    if "indentation" in contact:
        yield "nothing is pressed out", (contact["indentation"] >= 0).all()
    complementarity = (p * np.abs(g)).sum(axis=(1, 2)) / (penetration * p.sum(axis=(1, 2)))
    yield f"pressure stands only where the gap is closed: {complementarity.max():.1e}", (complementarity < 1e-8).all()
    overlap = -np.where(p == 0, g, 0).min(axis=(1, 2)) / penetration
    yield f"the bodies do not overlap: {overlap.max():.1e}", (overlap < 1e-7).all()
    if isolated:
        yield "the surface sinks everywhere", (w > 0).all()
    else:
        yield "displacements have zero mean", np.allclose(w.mean(axis=(1, 2)), 0, atol=1e-12)
    shape = g - w + penetration[:, None, None]
    yield "the undeformed shape is the same in every step", np.allclose(shape, shape[0], rtol=0, atol=1e-12)
    yield "every level faces samples", set(np.unique(contact["owner"])) == {level["level"] for level in steps[0]["levels"]}

    s, t = np.meshgrid(np.arange(n1) / n1, np.arange(n2) / n2, indexing="ij")
    # The middle of a window is the origin.
    s, t = (s - 0.5, t - 0.5) if isolated else (s, t)
    for axis, name in enumerate("xy"):
        place = s * contact["a1"][axis] + t * contact["a2"][axis]
        yield f"{name} follows the cell vectors", np.allclose(contact[name], place, rtol=0, atol=1e-12)
    owned = [(p[step] * (contact["owner"] == level["level"])).sum() / p[step].sum()
             for step in range(len(steps)) for level in steps[step]["levels"]]
    shares = [level["load_share"] for step in steps for level in step["levels"]]
    yield "load shares are sums over owners", np.allclose(owned, shares, rtol=1e-12, atol=1e-15)


def main():
    failed = 0
    for what, holds in checks(Path(sys.argv[1])):
        print("ok    " if holds else "FAILED", what)
        failed += not holds
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
