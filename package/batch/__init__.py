# SPDX-License-Identifier: GPL-3.0-or-later
"""Many models: ``reeb-parts batch``.

``sources`` finds the models, ``work`` does one of them, ``model_process`` does it in a process with limits, ``cluster``
spreads models over the workers of Dask, ``records`` knows what is done, and ``tables`` and ``page`` put all of it
together.
"""
