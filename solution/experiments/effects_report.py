"""The price list of effects as tables, bars, and lines that support the handouts' claims."""

from .table import Table, number


def make_tables(results):
    return [
        tabulate_prices(results["prices"], results["steps"]),
        tabulate_lesson(results["lesson"], results["middle"]),
        tabulate_bonus(results["bonus"]),
    ]


def in_thousands(opcodes):
    return number(opcodes / 1000) if opcodes < 1e6 else f"{opcodes / 1000:,.0f}"


def tabulate_prices(prices, steps):
    heads = ["effect", "on top of", *(f"{balls} balls" for balls in prices)]
    rows = []
    for lines in zip(*prices.values(), strict=True):
        base = lines[0]["base"]
        below = "" if base is None else " and ".join(base).lower() or "move only"
        rows.append([lines[0]["title"], below, *(in_thousands(line["price"]) for line in lines)])
    note = f"Each number is the mean of {steps} steps: Sleep looks at the balls in two of them."
    return Table("The price of each effect, in thousands of opcodes a step", heads, rows, note)


def tabulate_lesson(lines, middle):
    rows = [[line["title"], in_thousands(line["opcodes"]), line["done"]["pairs"]] for line in lines]
    heads = ["scene", "thousands of opcodes", "pairs"]
    return Table(f"Your engine: one step with {middle} balls", heads, rows)


def tabulate_bonus(sizes):
    """Show the price of a step before and after each bonus task, a row per pile."""
    heads = ["balls", *(line["title"] for line in next(iter(sizes.values())))]
    rows = [[n, *(in_thousands(line["opcodes"]) for line in lines)] for n, lines in sizes.items()]
    return Table("Your engine with bonus tasks, in thousands of opcodes a step", heads, rows)


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
    says = "From 40 balls on, contacts and friction are most of the price"
    return {"says": says, "x": "opcodes per step and ball", "bars": bars}


def make_lines(results):
    """Return the price list as lines: one number by name."""
    lines = {"python": results["python"].rpartition(".")[0]}
    sizes = [*results["prices"].items(), *results["bonus"].items()]
    piles = [(f"{balls} balls", rows) for balls, rows in sizes]
    for where, rows in [*piles, ("lesson", results["lesson"])]:
        for row in rows:
            lines |= list_step(f"{where}, {row['title']}", row)
            if "price" in row:
                lines[f"{where}, {row['title']}: price in opcodes"] = row["price"]
    return lines


def list_step(name, row):
    counts = {f"{name}: {what}": count for what, count in row["done"].items()}
    return {f"{name}: opcodes of a step": row["opcodes"], **counts}
