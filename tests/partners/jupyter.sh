# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# The notebooks, run from their beginning by Jupyter, with what they show; and tables of geopandas and pandas.
install jupyter-nbconvert python3-ipykernel python3-matplotlib python3-numpy python3-geopandas gdal-bin
build dev gable_python || return 1
for notebook in docs/notebooks/*.ipynb; do
  name=$(basename "$notebook")
  PYTHONPATH=$root/build/dev/python step "Notebook $name" "$name.log" \
    jupyter-nbconvert --to notebook --execute "$notebook" --output-dir "$out" --ExecutePreprocessor.timeout=600 || return 1
done
step "Tables of geopandas" geopandas.log /usr/bin/python3 -B tests/partners/jupyter/frames.py build/dev || return 1
cat build/log/geopandas.log
