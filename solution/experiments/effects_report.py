"""The price list of effects as tables, as bars, and as lines that the handouts rest on."""

from .table import Table

UNDECLARED = ("declared", "undeclared")


def make_tables(results):
    middle = results["middle"]
    return [
        tabulate_prices(results["prices"]),
        tabulate_steps(results["prices"][middle], f"One whole step with {middle} balls"),
        tabulate_undeclared(results["undeclared"], middle),
        tabulate_steps(results["lesson"], f"The lesson's engine: one step with {middle} balls"),
        tabulate_bonus(results["bonus"]),
    ]


def tabulate_prices(prices):
    heads = ["effect", "on top of", *(f"{balls} balls" for balls in prices)]
    rows = []
    for lines in zip(*prices.values(), strict=True):
        base = lines[0]["base"]
        below = "" if base is None else " and ".join(base).lower() or "move only"
        rows.append([lines[0]["title"], below, *(f"{line['price']:,}" for line in lines)])
    return Table("Price in opcodes per step", heads, rows)


def tabulate_steps(lines, title):
    heads = ["scene", "opcodes", *lines[0]["done"]]
    rows = [
        [line["title"], f"{line['opcodes']:,}", *(f"{count:,}" for count in line["done"].values())]
        for line in lines
    ]
    return Table(title, heads, rows)


def tabulate_undeclared(lines, middle):
    heads = ["effect", "its own files", "declared", "not declared"]
    rows = [
        [line["effect"], ", ".join(line["files"]), *(f"{line[key]:,}" for key in UNDECLARED)]
        for line in lines
    ]
    return Table(f"Opcodes per step in an effect's own files, {middle} balls", heads, rows)


def tabulate_bonus(sizes):
    heads = ["balls", "scene", "opcodes", "asleep", "calls to collide", "contacts"]
    rows = []
    for balls, lines in sizes.items():
        for line in lines:
            done = line["done"]
            counts = [line["opcodes"], line["asleep"], done["pairs"], done["contacts"]]
            counts.append(done["contact solves"])
            rows.append([balls, line["title"], *(f"{count:,}" for count in counts)])
    title = "The lesson's engine before and after bonus tasks B1 and B3"
    return Table(title, [*heads, "contact solves"], rows)


def make_bars(results):
    """Return a bar per size of the pile: opcodes per ball, one piece per effect."""
    bars = {
        f"{balls} balls": {
            line["title"]: line["price"] / int(balls)
            for line in lines
            if line["title"] in results["stacked"]
        }
        for balls, lines in results["prices"].items()
    }
    says = "Contacts and friction are most of the price"
    return {"says": says, "x": "opcodes per step and ball", "bars": bars}


def make_lines(results):
    """Return the price list by names: a line has one number."""
    lines = {}
    for balls, rows in results["prices"].items():
        for row in rows:
            lines[f"{balls} balls, {row['title']}: price in opcodes"] = row["price"]
            lines |= list_step(f"{balls} balls, {row['title']}", row)
    for row in results["undeclared"]:
        lines[f"{row['effect']}, not declared: opcodes in its own files"] = row["undeclared"]
    for row in results["lesson"]:
        lines |= list_step(f"lesson, {row['title']}", row)
    for balls, rows in results["bonus"].items():
        for row in rows:
            lines |= list_step(f"{balls} balls, {row['title']}", row)
    return lines


def list_step(name, row):
    counts = {f"{name}: {what}": count for what, count in row["done"].items()}
    return {f"{name}: opcodes of a step": row["opcodes"], **counts}
