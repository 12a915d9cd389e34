"""Cut unneeded definitions out of Python files; the rest stays unchanged."""

import ast
from collections.abc import Collection, Iterable, Iterator


def prune(source: str, roots: Iterable[str]) -> str:
    """Return the source without the definitions and imports that the `roots` do not need."""
    tree = ast.parse(source)
    definitions = {name: node for node in tree.body for name in list_defined(node)}
    wanted = set(roots).union(*(find_used(node) for node in tree.body if not list_defined(node)))
    needed: set[str] = set()
    while wanted:
        needed |= wanted
        nodes = {id(definitions[name]): definitions[name] for name in wanted if name in definitions}
        reached: set[str] = set().union(*map(find_used, nodes.values()))
        wanted = reached - needed
    changes: dict[ast.stmt, str] = {}
    for node in tree.body:
        names = list(list_defined(node))
        kept = [name for name in names if name in needed]
        if isinstance(node, ast.Import | ast.ImportFrom) and kept and kept != names:
            node.names = [each for each in node.names if find_bound_name(each) in needed]
            changes[node] = ast.unparse(node)
        elif names and not kept:
            changes[node] = ""
    return replace_nodes(source, changes)


def replace_bodies(source: str, bodies: dict[str, str]) -> str:
    """Remove the decorators of functions, and replace their bodies by these lines."""
    changes: dict[ast.stmt, str] = {}
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef) and node.name in bodies:
            lines = source.splitlines()
            documented = ast.get_docstring(node) is not None
            last = node.body[0].end_lineno if documented else node.body[0].lineno - 1
            head = lines[node.lineno - 1 : last]
            changes[node] = "\n".join([*head, f"    {bodies[node.name]}"])
    return replace_nodes(source, changes)


def replace_nodes(source: str, changes: dict[ast.stmt, str]) -> str:
    """Replace whole statements; if one is deleted, comments above it go too."""
    lines = source.splitlines()
    for node, text in sorted(changes.items(), key=lambda each: -each[0].lineno):
        decorators = getattr(node, "decorator_list", [])
        start = min([node.lineno, *(each.lineno for each in decorators)]) - 1
        while not text and start and lines[start - 1].startswith("#"):
            start -= 1
        lines[start : node.end_lineno] = text.splitlines()
    return "\n".join(drop_gaps(lines)) + "\n"


def drop_gaps(lines: list[str]) -> Iterator[str]:
    """Yield lines with at most two empty ones in a row, and none at the end."""
    text = "\n".join(lines).rstrip()
    empty = 0
    for line in text.splitlines():
        empty = 0 if line else empty + 1
        if empty <= 2:
            yield line


def list_defined(node: ast.stmt) -> Iterator[str]:
    match node:
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            yield name
        case ast.Import(names=names) | ast.ImportFrom(names=names):
            yield from map(find_bound_name, names)
        case ast.Assign(targets=targets):
            for target in targets:
                yield from (each.id for each in ast.walk(target) if isinstance(each, ast.Name))
        case ast.AnnAssign(target=ast.Name(id=name)):
            yield name


def list_names(body: Iterable[ast.stmt]) -> set[str]:
    """Return the functions, classes, variables and imports that statements define."""
    return {name for node in body for name in list_defined(node)}


def find_bound_name(alias: ast.alias) -> str:
    return alias.asname or alias.name.partition(".")[0]


def find_used(node: ast.AST) -> set[str]:
    return {
        each.id
        for each in ast.walk(node)
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load)
    }


def prune_modules(sources: dict[str, str], roots: dict[str, set[str]]) -> dict[str, str]:
    """Return the modules that the roots need, each without unneeded definitions.

    `sources` are texts by the modules' full names, and `roots` names in some of them.
    """
    wanted = {module: set(names) for module, names in roots.items()}
    texts: dict[str, str] = {}
    grown = set(wanted)
    while grown:
        texts |= {module: prune(sources[module], wanted[module]) for module in grown}
        uses = [each for module in grown for each in list_uses(texts[module], sources)]
        grown = {module for module, name in uses if name not in wanted.get(module, ())}
        for module, name in uses:
            wanted.setdefault(module, set()).add(name)
    return texts


def list_uses(source: str, modules: Collection[str]) -> Iterator[tuple[str, str]]:
    """Yield the names that a file takes from these modules, each with its module.

    An import of a whole module yields the empty name, and each attribute that the file uses.
    """
    tree = ast.parse(source)
    bound: dict[str, str] = {}  # names of modules in the file
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(module=str(module), names=names) if module in modules:
                yield from ((module, each.name) for each in names)
            case ast.ImportFrom(module=module, names=names):
                whole = {find_bound_name(each): f"{module}.{each.name}" for each in names}
                bound |= {name: each for name, each in whole.items() if each in modules}
    yield from ((module, "") for module in bound.values())
    for node in ast.walk(tree):
        match node:
            case ast.Attribute(value=ast.Name(id=owner), attr=name) if owner in bound:
                yield bound[owner], name
