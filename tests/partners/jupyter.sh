# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# The notebooks, run from their beginning by Jupyter, with what they show.
install jupyter-nbconvert python3-ipykernel python3-matplotlib python3-numpy
[ -d build/dev/python/gable ] || build dev gable_python || return 1
for notebook in docs/notebooks/*.ipynb; do
  PYTHONPATH=$root/build/dev/python jupyter-nbconvert --to notebook --execute "$notebook" \
    --output-dir "$out" --ExecutePreprocessor.timeout=600 >"$out/$(basename "$notebook").log" 2>&1 ||
    { cat "$out/$(basename "$notebook").log" && return 1; }
done
