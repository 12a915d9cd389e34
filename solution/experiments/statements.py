"""What a run says, line by line: a name and one number, or a word. The handouts rest on these.

A quick run has the lines of a full one that it measured. A range is two lines, least and most.
"""

from .answers import EXACT


def of_accuracy(results):
    """The lines of accuracy.py."""
    lines = {}
    for scene in results["budgets"].values():
        lines |= of_budgets(scene)
    for row in results["chain"]["rows"]:
        for look, share in zip(results["chain"]["looks"], row["shares"], strict=False):
            lines[f"swinging chain, {row['engine']}: energy left after {look} s"] = share
    lines |= of_smooth(results["smooth"])
    for answers in results["dials"].values():
        for error in answers["units"]:
            lines |= of_dials(answers, error)
    for row in results["piles"]:
        lines |= of_pile(row)
    for race in results["same step"]:
        lines |= of_same_step(race)
    return lines


def of_same_step(race):
    lines, pile = {}, f"pile of {race['balls']} in the same step"
    for row in race["rows"]:
        name = f"{pile}, {row['engine']} with {row['substeps']} substeps"
        lines[f"{name}: overlap"] = row["overlap"]
        lines |= ends(f"{name}: time in pymunk's", row["ratio"])
    return lines


def ends(name, values):
    """The two lines of a range, if there is one."""
    return {f"{name}, least": min(values), f"{name}, most": max(values)} if values else {}


def of_budgets(scene):
    lines = {}
    for engine, cells in scene["within"].items():
        for cell in cells:
            name = f"{scene['title']}, {engine}: {scene['error']} within {cell['budget']:g} ms"
            known = [end for end in (*cell["range"], cell["error"]) if not isinstance(end, str)]
            lines |= ends(name, known)
    for row in scene["equal"]["rows"]:
        name = f"{scene['title']}, {row['engine']}: time for the stable engine's error"
        lines |= ends(name, row["ratio"] if row["reached"] else None)
    return lines


def of_smooth(smooth):
    lines = {}
    for system in smooth["systems"]:
        for method in system["methods"]:
            lines[f"{system['title']}, {method['method']}: order"] = (
                method["order"] or "not reached"
            )
    for row in smooth["energy"]:
        name = f"orbit, {row['method']}: energy error"
        lines[f"{name} of the first round"] = row["peaks"][0]
        lines[f"{name} of the last round"] = row["peaks"][-1]
        if row["passes Verlet"]:
            lines[f"{name} above Verlet's from round"] = row["passes Verlet"]
    return lines


def of_dials(answers, error):
    """What each dial comes to at its first and last value, and what a digit costs by it."""
    lines, name = {}, f"{answers['title']}: {error}"
    default = next(run for run in answers["runs"] if run["default"])
    lines[f"{name}, lesson as it is"] = default["errors"][error]
    for row in answers["dials"]:
        which = f"{row['engine']}, {row['dial']}"
        first, last = (answers["runs"][row["runs"][i]] for i in (0, -1))
        for value, run in ((row["values"][0], first), (row["values"][-1], last)):
            lines[f"{name}, {which} {value}"] = run["errors"][error]
        verdict = row["verdicts"][error]
        lines[f"{name}, {which}: what it does"] = verdict["says"]
        lines |= ends(f"{name}, {which}: work for a digit", verdict["digit"])
        if first["opcodes"] and last["opcodes"]:
            lines[f"{answers['title']}, {which}: work of the last value in the first's"] = (
                last["opcodes"] / first["opcodes"]
            )
            lines[
                f"{answers['title']}, {which}: work of the last value in that of lesson as it is"
            ] = last["opcodes"] / default["opcodes"]
    known = [run["errors"][error] for run in answers["runs"] if run["engine"] == "lesson"]
    known = [one for one in known if not isinstance(one, str)]
    if known:
        lines[f"{name}, lesson: least with any dial"] = max(min(known), EXACT)
    return lines


def of_pile(row):
    lines = {}
    for name, found in row.items():
        if name != "balls":
            which = f"pile of {row['balls']}, {name}"
            lines |= ends(f"{which}: times as fast as lesson", found["ratio"])
            if "overlap" in found:
                lines[f"{which}: overlap"] = found["overlap"]
    return lines


# ---------------------------------------------------------------- effects


def of_effects(results):
    """The lines of the price list of effects."""
    lines = {}
    for balls, rows in results["prices"].items():
        for row in rows:
            lines[f"{balls} balls, {row['title']}: price in opcodes"] = row["price"]
            lines[f"{balls} balls, {row['title']}: opcodes of a step"] = row["opcodes"]
            for what, count in row["done"].items():
                lines[f"{balls} balls, {row['title']}: {what}"] = count
    for row in results["undeclared"]:
        lines[f"{row['effect']}, not declared: opcodes in its own files"] = row["undeclared"]
    for row in results["lesson"]:
        lines[f"lesson, {row['title']}: opcodes of a step"] = row["opcodes"]
        for what, count in row["done"].items():
            lines[f"lesson, {row['title']}: {what}"] = count
    for balls, rows in results["bonus"].items():
        for row in rows:
            lines[f"{balls} balls, {row['title']}: opcodes of a step"] = row["opcodes"]
            for what, count in row["done"].items():
                lines[f"{balls} balls, {row['title']}: {what}"] = count
    return lines
