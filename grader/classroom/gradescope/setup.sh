#!/bin/sh
# Gradescope runs this once, when the zip is uploaded. The folder may be named, to try it elsewhere.
set -eu
top=${1:-/autograder}
source=$top/source

# Of these versions any will do. Ubuntu 22.04, Gradescope's usual system, has 3.11 as a package.
python=
for version in $(cat "$source/pythons"); do
    if "python$version" -c 'import ensurepip, venv' 2>/dev/null; then
        python=python$version
        break
    fi
done
if [ -z "$python" ]; then
    apt-get update || true  # an image may have none of the lists, or old ones
    for version in $(cat "$source/pythons"); do
        if apt-get install -y "python$version" "python$version-venv"; then
            python=python$version
            break
        fi
    done
fi
if [ -z "$python" ]; then
    echo "The grader needs one of Python $(cat "$source/pythons"): choose a newer base image." >&2
    exit 1
fi

"$python" -m venv "$top/python"
if [ -d "$source/wheels" ]; then
    set -- --no-index --find-links "$source/wheels"
else
    set --
fi
"$top/python/bin/python" -m pip install --require-hashes "$@" -r "$source/requirements.txt"
