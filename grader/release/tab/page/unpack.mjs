// Unpacks an archive of the page into the folders from which its Python imports.
const UNPACK = `
import importlib, io, os, sys, zipfile

with zipfile.ZipFile(io.BytesIO(packed.to_bytes())) as outer:
    solid = io.BytesIO(outer.read("all.zip"))
with zipfile.ZipFile(solid) as archive:
    archive.extractall("/")
for place, _, _ in os.walk("/stdlib"):  # it may be a part of a package that Python has loaded
    name = place.removeprefix("/stdlib/").replace("/", ".")
    places = getattr(sys.modules.get(name), "__path__", [])
    if place not in places:
        places.append(place)
for place in ("/site", "/kit", "/shims"):
    if place not in sys.path:
        sys.path.insert(0, place)
if "/stdlib" not in sys.path:
    sys.path.append("/stdlib")
importlib.invalidate_caches()
`;

export function unpack(python, packed) {
  python.globals.set("packed", packed);
  python.runPython(UNPACK);
  python.globals.delete("packed");
}
