# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut many models into parts, on all processors of this machine or on a cluster.

    reeb-parts batch archive "more/**/*.glb" --out results --colored ply --parts glb

Each model gets a folder below OUT/models with what is asked for; OUT/models.parquet and OUT/parts.parquet have a row
for each model and for each part, and OUT/index.html shows all of them. A model that cannot be read, needs too much
memory or time, or ends the process that computes it costs only itself, and its row says why. What is done - the same
bytes, the same parameters, the same version - is not done again: a run that was interrupted goes on where it was.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import closing, suppress
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

from ..batch.records import CRASH, DONE, OPEN, Settings, failure, is_done, record_of, write_record
from ..batch.sources import FOLDERS, Source, find_sources, folder_of, is_gone, read_list
from ..core.errors import ReebError
from ..core.file_names import readable
from ..core.options import add_parameters, answer_text, chosen_parameters, named_folder, number
from ..core.sentence import Sentence
from ..model_files import BY_BLENDER, formats
from ..output_files import OutputFileError, SharedFolder, as_output_error, check_folder
from ..outputs import COLORED, LABELS, PARTS
from .words import INTERRUPTED, print_answer, say

NEEDED = ("distributed", "pyarrow", "tqdm", "psutil")


class MissingPackageError(ReebError):
    """A package of the extra "batch" is not there."""


def check_packages(*names: str) -> None:
    """Raise MissingPackageError unless all of some packages are there."""
    missing = [name for name in names if find_spec(name) is None]
    if missing:
        raise MissingPackageError(Sentence('Install {names} first: pip install "reeb-parts[batch]".',
                                           names=", ".join(missing)))


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options to a parser."""
    parser.add_argument("models", nargs="*", metavar="MODELS", help="folders, which are searched with all that is in "
                        'them, patterns such as "*.obj" and "**/*.ply", and files')
    parser.add_argument("--list", type=Path, action="append", default=[], metavar="FILE",
                        help="a file that lists more of them, one a line")
    parser.add_argument("--out", type=named_folder, required=True, metavar="DIR", help="folder for the results")
    parser.add_argument("--root", type=named_folder, metavar="DIR", help="folder below which models have their names; "
                        "without it that of MODELS, the innermost one that holds all of them")
    parser.add_argument("--blender", metavar="PATH", help="the Blender that reads " + ", ".join(BY_BLENDER))
    files = parser.add_argument_group("files for each model")
    files.add_argument("--json", action=argparse.BooleanOptionalAction, default=True, help="the JSON document")
    files.add_argument("--labels", choices=_kinds(LABELS), default="npy",
                       help="the part of each face (default: %(default)s)")
    files.add_argument("--colored", choices=_kinds(COLORED), help="the model in the colors of its parts")
    files.add_argument("--parts", choices=PARTS, help="a file for each part")
    files.add_argument("--thumbnail", type=int, choices=(64, 96, 128, 192, 256), default=128,
                       help="pixels along a side of the pictures (default: %(default)s)")
    run = parser.add_argument_group("how to run")
    run.add_argument("--workers", type=number(1, kind=int), metavar="N",
                     help="processes on this machine (default: one for each processor that may be used)")
    run.add_argument("--scheduler", metavar="ADDRESS", help="use the Dask cluster that is there instead, such as "
                     "tcp://host:8786; its workers have this package and see the same folders")
    run.add_argument("--dashboard", type=_address, default="127.0.0.1:8787", metavar="ADDRESS",
                     help="where Dask's dashboard is shown (default: %(default)s)")
    # More are bytes by mistake, and no number that the system takes.
    run.add_argument("--memory-limit", type=number(0, 100_000), metavar="GIB",
                     help="memory of one model (default: that of the machine, or of the container, divided by the "
                     "number of its workers)")
    run.add_argument("--time-limit", type=number(0), default=600.0, metavar="SECONDS",
                     help="time of one model, 0 for any (default: %(default)g)")
    run.add_argument("--retry", action="store_true", help="also try models again that were refused before")
    add_parameters(parser.add_argument_group("parameters"))


def run(options: argparse.Namespace) -> int:
    """Do what the options ask for; returns the exit status. Raises ReebError."""
    check_packages(*NEEDED)
    start = time.perf_counter()
    batch = _Batch(options)
    with as_output_error(batch.out):
        batch.out.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=batch.out):  # or each model would be computed, and none could be written
            pass
        _check_places(batch.out)
        shared = SharedFolder(batch.out)
    interrupted = False
    with shared:
        alone = shared.remove_leftovers()
        try:
            batch.run(alone)
        except KeyboardInterrupt:
            interrupted = True
            say("Interrupted; what is done is kept.")
        shared.remove_leftovers()  # of processes that were ended while they wrote
        with as_output_error(batch.out):
            answer = batch.finish()
    if batch.unread:
        answer["unread"] = batch.unread
    answer["seconds"] = round(time.perf_counter() - start, 3)
    print_answer(answer_text(answer))
    all_done = not batch.unread and all(status == DONE for status in answer["models"])
    return INTERRUPTED if interrupted else int(not all_done)


def _check_places(out: Path) -> None:
    """Raise OutputFileError where results could not be put in their places, as something else has their names."""
    from ..batch.page import PAGE
    from ..batch.tables import MODELS_TABLE, PARTS_TABLE

    check_folder(out / FOLDERS)
    for path in (out / MODELS_TABLE, out / PARTS_TABLE, out / PAGE):
        with as_output_error(path):
            if path.exists() and not path.is_file():
                raise OutputFileError(Sentence("{path} is no file, and the run writes one of that name. Remove it, or "
                                               "choose another folder with --out.", path=path))


class _Batch:
    """A run over many models.

    options : as ``add_options`` has them. Raises ReebError where they make no sense.
    """

    def __init__(self, options: argparse.Namespace) -> None:
        parameters, notes = chosen_parameters(options)
        for note in notes:
            say(note)
        self.options = options
        self.out = Path(os.path.abspath(options.out))
        listed = [place for path in options.list for place in read_list(path)]
        self.unread: list[str] = []
        # Without a Blender, too: that a model could not be read is to be seen in the table.
        kinds = formats() + BY_BLENDER
        gone = self._gone(listed, kinds)
        places = [*options.models, *(place for place in listed if place not in gone)]
        self.sources = find_sources(places, kinds, self.out, options.root, self._unread, gone)
        self.settings = Settings(parameters, options.json, _suffix(options.labels), _suffix(options.colored),
                                 options.parts or "", options.thumbnail)
        self.blender = options.blender
        # Workers of a cluster have working folders of their own; a mere name is looked for on the PATH of each.
        if self.blender and os.path.dirname(self.blender):
            self.blender = os.path.abspath(self.blender)
        self.kept = 0
        self.failed: dict[str, tuple[str, str]] = {}  # status and reason, by the name of the model

    def _gone(self, listed: list[str], kinds: tuple[str, ...]) -> set[str]:
        """The places of lists where a model was, which it names: an archive is not refused for them."""
        gone = [place for place in listed if is_gone(place, kinds)]
        if gone:
            self.unread += map(readable, gone)
            say(f"{len(gone)} of {len(listed)} in the list cannot be found (first: {gone[0]}).")
        return set(gone)

    def _unread(self, error: OSError) -> None:
        """Say that a folder or a model is left out; a folder that is gone by now has no models."""
        if not isinstance(error, FileNotFoundError):
            self.unread.append(readable(error.filename))
            say(f"{error.filename} could not be read: {error.strerror}")

    def folder(self, source: Source) -> Path:
        """Where the results of a model are."""
        return folder_of(self.out, source.name)

    def run(self, alone: bool) -> None:
        """Do all models that are not done yet; raises KeyboardInterrupt after Ctrl+C.

        alone : bool, whether no other run writes to the same folder. Runs that share one do not go the same way, or
        all would come to each model at the same time.
        """
        from tqdm import tqdm

        with tqdm(self.sources, desc="looking", unit="model", disable=None, leave=False) as looking:
            waiting = [source for source in looking
                       if not is_done(source.path, self.folder(source), self.settings, self.options.retry, source.name)]
        self.kept = len(self.sources) - len(waiting)
        if self.kept:
            say(f"{self.kept} of {_models(len(self.sources))} {'is' if self.kept == 1 else 'are'} done already.")
        if not waiting:
            return
        if not alone:
            random.shuffle(waiting)
        # Dask takes long to import, and a look at what is done needs none of it.
        from ..batch.cluster import SchedulerLostError

        try:
            self._spread(waiting)
        except SchedulerLostError as error:
            say(str(error))

    def _spread(self, waiting: list[Source]) -> None:
        """Have some models done by a cluster; raises SchedulerLostError."""
        from tqdm import tqdm

        from ..batch import cluster

        with cluster.connected(self.options.scheduler, self.workers, self.options.dashboard) as client:
            say(f"Dask's dashboard: {client.dashboard_link}")
            if not cluster.n_threads(client):  # they may be on their way, as where a cluster grows with its work
                say("The cluster has no workers; the models wait for some.")
            failed: Counter[str] = Counter()
            with (tqdm(total=len(waiting), desc="models", unit="model", smoothing=0.1, mininterval=0.5) as progress,
                  closing(cluster.spread(client, cluster.do_job, self._jobs(waiting, progress))) as answers):
                for job, answer in answers:
                    if isinstance(answer, BaseException):
                        answer = self._lost(job, answer)
                    if answer.get("kept"):
                        self.kept += 1
                    elif answer["status"] != DONE:
                        failed[answer["status"]] += 1
                        progress.set_postfix(failed, refresh=False)
                        self._note_failure(job["name"], answer["status"], answer["reason"])
                    progress.update()

    def _note_failure(self, name: str, status: str, reason: str) -> None:
        """Keep what became of a model for the answer, and say it above the bar of progress."""
        from tqdm import tqdm

        self.failed[name] = status, reason
        tqdm.write(f"reeb-parts: {name}: {status}: {reason}", file=sys.stderr)

    @property
    def workers(self) -> int:
        """How many processes on this machine: one for each processor that may be used, unless the user has said."""
        from dask.system import cpu_count

        return self.options.workers or cpu_count()

    def _jobs(self, sources: list[Source], progress: Any) -> Iterator[dict[str, Any]]:
        """What the workers are given of some models, without those that another run has done by the time of each."""
        for source in sources:
            if is_done(source.path, self.folder(source), self.settings, self.options.retry, source.name):
                self.kept += 1
                progress.update()
            else:
                yield self._job(source)

    def _job(self, source: Source) -> dict[str, Any]:
        """What a worker is given."""
        from distributed.system import memory_limit

        limit = self.options.memory_limit
        # The workers of a cluster may be machines of another size, and know it.
        own = 0 if self.options.scheduler else memory_limit() // self.workers
        memory = int(limit * 2**30) if limit else own
        return {"path": str(source.path), "name": source.name, "folder": str(self.folder(source)),
                "settings": self.settings.to_dict(), "blender": self.blender, "memory_limit": memory,
                "time_limit": self.options.time_limit, "retry": self.options.retry}

    def _lost(self, job: dict[str, Any], error: BaseException) -> dict[str, Any]:
        """Record a model whose workers ended one after the other."""
        reason = f"The workers that had it ended: {error}"
        with suppress(OSError):  # such as a full disk: it will be tried again
            write_record(job, failure(job["name"], CRASH, reason, self.settings.digest))
        return {"status": CRASH, "reason": reason}

    def finish(self) -> dict[str, Any]:
        """Write the tables and the page; returns what the command answers."""
        from ..batch.page import write_page
        from ..batch.tables import write_tables

        def rows() -> Iterator[tuple[dict[str, Any], Path, Path]]:
            for source in self.sources:
                record = self._record(source)
                statuses[record["status"]] += 1
                yield record, source.path, self.folder(source)

        statuses: Counter[str] = Counter()
        models, parts = write_tables(self.out, rows())
        counted = dict(statuses)
        page = write_page(self.out, _models(len(self.sources)), rows(), len(self.sources), self.sources[0].path)
        return {"models": counted, "kept": self.kept, "files": {
            "models": readable(models), "parts": readable(parts), "page": readable(page),
            "folders": readable(self.out / FOLDERS)}}

    def _record(self, source: Source) -> dict[str, Any]:
        """The record of a model; where it could not be written, as on a full disk, one of what its worker has said."""
        record = record_of(source.name, self.folder(source), self.settings.digest)
        if record["status"] == OPEN and source.name in self.failed:
            return failure(source.name, *self.failed[source.name], self.settings.digest)
        return record


def _models(count: int) -> str:
    """So many models."""
    return Sentence("{n} {n:model|models}", n=count)


def _address(text: str) -> str:
    """A host and a port, or a port; argparse turns the error into a sentence."""
    host, _, port = text.rpartition(":")
    if ":" in host or not port.isdecimal() or int(port) > 65535:
        raise argparse.ArgumentTypeError(f"{text} is no address such as 127.0.0.1:8787")
    return text


def _kinds(suffixes: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(suffix.lstrip(".") for suffix in suffixes)


def _suffix(kind: str | None) -> str:
    return f".{kind}" if kind else ""
