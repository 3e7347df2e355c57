# SPDX-License-Identifier: GPL-3.0-or-later
"""Find the parts of a batch that are most like one of them.

    reeb-parts similar results "cow.obj:3" --count 20 --page similar.html

PART is the name of a model in the tables and the number of a part. The answer on standard output is JSON; the page has
a picture of each part. Parts are compared by size, shape and place in the Reeb graph, which change little with pose.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from ..core.file_names import readable
from ..core.options import answer_text
from ..core.options import number as number_option
from ..core.sentence import Sentence
from ..output_files import OutputFileError, write_files
from .batch import check_packages
from .decompose import file_of
from .words import print_answer


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options to a parser."""
    parser.add_argument("results", type=Path, help="folder of the results of reeb-parts batch")
    parser.add_argument("part", type=_part, metavar="PART", help="such as cow.obj:3")
    parser.add_argument("--count", type=number_option(1, kind=int), default=20, metavar="N",
                        help="how many (default: %(default)s)")
    parser.add_argument("--other-models", action="store_true", help="leave out the parts of the same model")
    parser.add_argument("--page", type=file_of((".html", ".htm")), metavar="OUT.html",
                        help="a page with a picture of each")


def run(options: argparse.Namespace) -> int:
    """Do what the options ask for; returns the exit status. Raises ReebError."""
    check_packages("pyarrow")
    from ..batch.page import PAGE
    from ..batch.similar import page, similar_parts

    model, number = options.part
    parts = similar_parts(options.results, model, number, options.count, options.other_models)
    if options.page:
        if options.page.resolve() == (options.results / PAGE).resolve():
            raise OutputFileError(Sentence("{path} shows all models of the batch. Choose another name.",
                                           path=options.page))
        write_files({options.page: page(options.results, parts).encode()}, options.results / "parts.parquet")
    print_answer(answer_text({"part": parts[0], "similar": parts[1:]}))
    return 0


def _part(text: str) -> tuple[str, int]:
    """The model and the number of a part; argparse turns the error into a sentence."""
    model, colon, number = text.rpartition(":")
    if not (colon and number.isdecimal()):
        raise argparse.ArgumentTypeError(f"{text} must be the name of a model, a colon and a number")
    return readable(model), int(number)  # as names are in the tables
