#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws error over time of Oriel, Oriel without what paths learn, and Blender's Cycles.

    bench/cycles/plots.py --oriel build/release/bin/oriel --probe STUDIO.hdr --keep DIR [SCENE ...]

Renders the scenes of catalogue.py with growing numbers of samples, fixed and adaptive, in
alternation, and writes docs/images/convergence/SCENE.svg and a table of the times to equal error.
Errors and times are those of compare.py, whose converged pictures are in the folder DIR; the
measurements are kept there, too. With --one-reference the converged picture of Oriel is that of
both programs, for scenes where Cycles does not converge in reasonable time. Requires Debian's
`python3-matplotlib` besides.
"""
import json
import os
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compare  # noqa: E402  beside this file
import measure  # noqa: E402

SAMPLES = (4, 16, 64)
TARGETS = (1e-2, 1e-3)
OUT = os.path.join(HERE, "../../docs/images/convergence")
PROGRAMS = {"Oriel": "#1b6ca8", "Oriel --no-guiding": "#7fb3d5", "Cycles": "#d9822b"}


def points(args, name, folder):
    """Seconds and error of each program for each number of samples, and of one adaptive picture."""
    path = os.path.join(args.keep, name + "_convergence.json")
    if os.path.exists(path):
        with open(path, encoding="utf-8") as f:
            return json.load(f)
    oriel = compare.Oriel(args, name, folder)
    cycles = compare.Cycles(args, name, folder, oriel)
    renderers = dict(zip(PROGRAMS, (oriel, compare.Oriel(args, name, folder, "--no-guiding"), cycles)))
    references = {"Oriel": compare.reference(oriel, args, name, "oriel")}
    references["Cycles"] = (references["Oriel"] if args.one_reference
                            else compare.reference(cycles, args, name, "cycles"))
    found = {program: {"fixed": [], "adaptive": []} for program in PROGRAMS}
    for kind, samples in [("fixed", n) for n in SAMPLES] + [("adaptive", SAMPLES[-1])]:
        for program, renderer in renderers.items():
            run = renderer.render(samples, 100 + samples, adaptive=kind == "adaptive")
            error = measure.error(run["picture"], references[program.split()[0]])
            found[program][kind].append((run["seconds"], error))
    with open(path, "w", encoding="utf-8") as f:
        json.dump(found, f)
    return found


def time_to(error, fixed):
    """Seconds to an error: between measured points on log-log axes, beyond them as 1 / error."""
    seconds, errors = numpy.array(sorted(fixed)).T
    if error >= errors[0]:
        return seconds[0] * errors[0] / error
    if error <= errors[-1]:
        return seconds[-1] * errors[-1] / error
    return float(numpy.exp(numpy.interp(-numpy.log(error), -numpy.log(errors), numpy.log(seconds))))


def draw(name, found):
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = name  # the same bytes for the same figures
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(5, 3.6))
    for program, colour in PROGRAMS.items():
        axes.plot(*zip(*found[program]["fixed"]), "o-", color=colour, label=program)
        axes.plot(*zip(*found[program]["adaptive"]), "x", color=colour)
    axes.set(xscale="log", yscale="log", xlabel="seconds of one thread",
             ylabel="squared relative error", title=name.replace("_", " "))
    axes.grid(True, which="major", alpha=.3)
    axes.plot([], [], "kx", label="adaptive")
    axes.legend(frameon=False)
    figure.savefig(os.path.join(OUT, name + ".svg"), bbox_inches="tight", metadata={"Date": None})
    pyplot.close(figure)


def row(name, found):
    """Times to equal error at the error of Oriel's last picture; seconds to given errors."""
    last = found["Oriel"]["fixed"][-1]
    factors = [time_to(last[1], found[p]["fixed"]) / last[0] for p in list(PROGRAMS)[1:]]
    ours, theirs = (found[p]["adaptive"][0] for p in ("Oriel", "Cycles"))
    adaptive = theirs[0] * theirs[1] / (ours[0] * ours[1])
    times = [f"{time_to(e, found[p]['fixed']):.3g}" for e in TARGETS for p in ("Oriel", "Cycles")]
    return (f"| {name} | {factors[0]:.2f} | {factors[1]:.2f} | {adaptive:.2f} | "
            f"{times[0]} / {times[1]} | {times[2]} / {times[3]} |")


def main():
    parser = compare.parser_of(__doc__)
    parser.add_argument("--keep", required=True, help="folder for pictures and measurements")
    parser.add_argument("--reference", type=int, default=1024, help="samples of converged pictures")
    parser.add_argument("--one-reference", action="store_true", help="that of Oriel, for both programs")
    parser.add_argument("--adaptive", type=float, default=.05, help="noise threshold")
    args = compare.parsed(parser)
    os.makedirs(OUT, exist_ok=True)
    print("| scene | --no-guiding / Oriel | Cycles / Oriel | adaptive | to .01, Oriel / Cycles | to .001 |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name in args.scenes:
            found = points(args, name, folder)
            draw(name, found)
            print(row(name, found), flush=True)


if __name__ == "__main__":
    main()
