"""How the price list of effects looks: tables, and figures where matplotlib is there."""

from .costs import in_shares, middle_half
from .table import Table, span

COLOURS = {  # safe for colour-blind eyes
    "move only": "#bbbbbb",
    "contacts": "#0072b2",
    "friction": "#56b4e9",
    "bounce": "#009e73",
    "10 rods": "#d55e00",
    "10 springs": "#e69f00",
    "damping": "#f0e442",
    "10 bullets, slow": "#cc79a7",
    "sleep, all awake": "#444444",
}
NO_MATPLOTLIB = "No figures: they need matplotlib. To get it: python -m pip install matplotlib"


# ---------------------------------------------------------------- tables


def tables(results):
    """All tables."""
    middle = results["middle"]
    return [
        price_table(results["prices"]),
        step_table(results["prices"][middle], f"One whole step with {middle} balls"),
        undeclared_table(results["undeclared"], middle),
        step_table(results["lesson"], f"The lesson's engine: one step with {middle} balls"),
        bonus_table(results["bonus"]),
    ]


def price_table(prices):
    heads = ["effect", "on top of", *(f"{balls} balls" for balls in prices)]
    rows = []
    for lines in zip(*prices.values(), strict=True):
        base = lines[0]["base"]
        below = "" if base is None else " and ".join(base).lower() or "move only"
        rows.append([lines[0]["title"], below, *(f"{line['price']:,}" for line in lines)])
    return Table("Price in opcodes per step", heads, rows)


def step_table(lines, title):
    """What a step takes. The first row's time is the unit of the others."""
    compiled = ["compiled ms"] if lines[0].get("compiled ms") else []
    heads = ["scene", "opcodes", "ms", "times the first", *compiled, *lines[0]["done"]]
    rows = []
    for line in lines:
        ratio = middle_half(in_shares(line["ms"], lines[0]["ms"]))
        cost = [f"{line['opcodes']:,}", span(middle_half(line["ms"])), span(ratio)]
        cost += [span(middle_half(line[name])) for name in compiled]
        rows.append([line["title"], *cost, *(f"{number:,}" for number in line["done"].values())])
    return Table(title, heads, rows)


def undeclared_table(lines, middle):
    heads = ["effect", "its own files", "declared", "not declared"]
    rows = [
        [
            line["effect"],
            ", ".join(line["files"]),
            f"{line['declared']:,}",
            f"{line['undeclared']:,}",
        ]
        for line in lines
    ]
    return Table(f"Opcodes per step in an effect's own files, {middle} balls", heads, rows)


def bonus_table(sizes):
    """Before and after the bonus tasks; each pile's time before is the unit of its others."""
    heads = ["balls", "scene", "opcodes", "ms", "share of before", "asleep", "calls to collide"]
    rows = []
    for balls, lines in sizes.items():
        for line in lines:
            ratio = middle_half(in_shares(line["ms"], lines[0]["ms"]))
            cost = [f"{line['opcodes']:,}", span(middle_half(line["ms"])), span(ratio)]
            done = line["done"]
            counts = [line["asleep"], done["pairs"], done["contacts"], done["contact solves"]]
            rows.append([balls, line["title"], *cost, *(f"{number:,}" for number in counts)])
    title = "The lesson's engine before and after bonus tasks B1 and B3"
    return Table(title, [*heads, "contacts", "contact solves"], rows)


# ---------------------------------------------------------------- figures


def figures(results, folder):
    """Draw both figures, as SVG and PNG. Returns a sentence about where they are."""
    try:
        import matplotlib
    except ImportError:
        return NO_MATPLOTLIB
    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "effects"  # the same file from the same numbers
    matplotlib.rcParams["svg.fonttype"] = "none"
    save(stacked_bars(results), folder, "effects-stacked")
    save(growth(results), folder, "effects-growth")
    return f"Figures: {folder}/effects-stacked.png and effects-growth.png, and the same as .svg"


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
    figure.savefig(folder / f"{name}.png", dpi=110)


def stacked_bars(results):
    """A bar per size of the pile: opcodes per ball, one piece per effect."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 3.8), layout="constrained")
    axes = figure.subplots()
    sizes = list(results["prices"])
    bottoms = [0.0] * len(sizes)
    for title in results["stacked"]:
        heights = [price(results, size, title) / int(size) for size in sizes]
        labels = [f"{size} balls" for size in sizes]
        axes.barh(labels, heights, left=bottoms, color=COLOURS[title], label=title, height=0.62)
        bottoms = [low + height for low, height in zip(bottoms, heights, strict=True)]
    axes.invert_yaxis()
    axes.set_xlabel("opcodes per step and ball")
    axes.set_title("Contacts and friction are most of the price", loc="left")
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside lower center", ncols=5, frameon=False)
    return figure


def growth(results):
    """A line per effect: its price against the number of balls."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 4.6), layout="constrained")
    axes = figure.subplots()
    sizes = [int(size) for size in results["prices"]]
    for title in results["stacked"]:
        prices = [price(results, str(size), title) for size in sizes]
        axes.loglog(sizes, prices, "o-", color=COLOURS[title], label=title)
    axes.set_xticks(sizes, [str(size) for size in sizes])
    axes.minorticks_off()
    axes.set_xlabel("balls in the pile")
    axes.set_ylabel("price, opcodes per step")
    axes.set_title("Ten rods cost ten rods, however many balls lie around", loc="left")
    axes.grid(color="#e5e5e5")
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside right center", frameon=False)
    return figure


def price(results, size, title):
    """The price (opcodes per step) of one row."""
    return next(line["price"] for line in results["prices"][size] if line["title"] == title)
