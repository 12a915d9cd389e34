// Runs a program with the page's own Python, in Node.js, when the page is made: it sees one folder.
import { readFileSync } from "node:fs";

const [pyodide, program, folder] = process.argv.slice(2);
const { loadPyodide } = await import(`${pyodide}/pyodide.mjs`);
const python = await loadPyodide({ indexURL: `${pyodide}/`, env: { PYTHONHASHSEED: "0" } });
python.mountNodeFS("/parts", folder);
python.runPython(readFileSync(program, "utf8"));
process.exit(0);
