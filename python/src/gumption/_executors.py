"""Runs distributed by executors: workers make ranges of blocks, which are merged here in any order.

Workers receive and return the bytes of the files of ``gumption run --blocks`` and ``gumption
merge``. Every part therefore identifies its run, pass and blocks, and a part of another run is
rejected.
"""

from __future__ import annotations

import functools
import importlib
import os
import pickle
import tempfile
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent import futures
from contextlib import closing
from typing import TYPE_CHECKING, Any

from gumption import _gumption
from gumption._keywords import called

if TYPE_CHECKING:
    from gumption._model import Model

#: How often the same work may get lost with its worker before that is told.
MOST_LOST = 5

#: Parts of a pass, at least: what a lost worker costs is one of them.
FEWEST_PARTS = 64

#: Parts for each worker, so that none waits long for the last one.
PARTS_OF_WORKER = 8

#: Blocks of a part, at least: shorter ones cost more to carry than to make.
FEWEST_BLOCKS = 64

#: Blocks of a part, at most: some seconds of work, for so long is what a stop waits for and what a lost
#: worker costs.
MOST_BLOCKS = 1 << 17

#: One unit of work: a function of a module, and what it is called with.
Work = tuple[Callable[..., Any], tuple[Any, ...]]


class Lost(Exception):
    """Work was lost with its worker, without an error of the work itself."""


class Workers:
    """Workers behind an executor of ``concurrent.futures``.

    A process pool broken by a dead process is replaced by an equal one.
    """

    def __init__(self, executor: futures.Executor) -> None:
        self._executor = executor
        # in place of one that was lost
        self._own: futures.Executor | None = None

    @staticmethod
    def of(executor: Any) -> Workers:
        """The workers behind an executor, a Dask client, or the module ``ray``."""
        if isinstance(executor, futures.Executor):
            return (_LokyWorkers if hasattr(executor, "get_reusable_executor") else Workers)(executor)
        if callable(getattr(executor, "nthreads", None)):
            return _DaskWorkers(executor)
        if getattr(executor, "__name__", None) == "ray":
            return _RayWorkers(executor)
        raise TypeError(
            "`executor` must be an executor of concurrent.futures or loky, a Dask client, or the module "
            f"`ray`, not {type(executor).__name__}"
        )

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        if self._own is not None:
            self._own.shutdown(wait=False, cancel_futures=True)

    @property
    def count(self) -> int:
        """Number of workers, if it is known; never 0."""
        known = getattr(self._executor, "_max_workers", None)
        return known if isinstance(known, int) and known > 0 else os.cpu_count() or 1

    def pickled(self, what: object) -> bytes:
        """The data for every worker, as bytes."""
        return pickle.dumps(what)

    def _result(self, future: futures.Future[Any]) -> Any:
        try:
            return future.result()
        except (futures.BrokenExecutor, futures.CancelledError) as error:
            raise Lost from error

    def _cancel(self, future: futures.Future[Any]) -> None:
        future.cancel()

    def done(self, work: Iterator[Work]) -> Generator[tuple[Work, Any], None, None]:
        """All work items with their results, in order of completion.

        Only as many items are submitted as the workers need, so that the queue does not grow. Work
        lost with its worker is repeated.
        """
        # with how often it was lost
        waiting: dict[futures.Future[Any], tuple[Work, int]] = {}
        again: deque[tuple[Work, int]] = deque()
        try:
            while True:
                most = 2 * self.count + 2
                while len(waiting) < most:
                    if again:
                        one = again.popleft()
                    elif (fresh := next(work, None)) is not None:
                        one = (fresh, 0)
                    else:
                        break
                    waiting[self._submit(one[0])] = one
                if not waiting:
                    return
                ended, _ = futures.wait(waiting, return_when=futures.FIRST_COMPLETED)
                for future in ended:
                    done, lost = waiting.pop(future)
                    try:
                        found = self._result(future)
                    except Lost as error:
                        if lost == MOST_LOST:
                            raise RuntimeError(
                                f"the same work was lost with its worker {MOST_LOST + 1} times, so it "
                                "is likely what ends them (memory?)"
                            ) from error
                        again.append((done, lost + 1))
                    else:
                        yield done, found
        finally:
            for future in waiting:
                self._cancel(future)

    def _submit(self, work: Work) -> futures.Future[Any]:
        function, arguments = work
        try:
            return self._executor.submit(function, *arguments)
        except futures.BrokenExecutor as error:
            self._replace(error)
            return self._executor.submit(function, *arguments)

    def _replace(self, error: futures.BrokenExecutor) -> None:
        """Replaces a pool broken by a dead process."""
        broken = self._executor
        if not isinstance(broken, futures.ProcessPoolExecutor):
            raise error
        # the pool has no other way to say how it was made
        settings = {
            name: getattr(broken, f"_{name}", None)
            for name in ("max_workers", "mp_context", "initializer", "initargs")
        }
        settings["initargs"] = settings["initargs"] or ()
        if self._own is not None:
            self._own.shutdown(wait=False, cancel_futures=True)
        self._own = self._executor = futures.ProcessPoolExecutor(**settings)  # type: ignore[arg-type]


class _LokyWorkers(Workers):
    """The workers behind the reusable executor of loky, as joblib has it."""

    def pickled(self, what: object) -> bytes:
        # of the loky that is there: joblib has one of its own, and older versions a cloudpickle
        loky = type(self._executor).__module__.rpartition(".")[0]
        found = importlib.import_module(f"{loky}.cloudpickle_wrapper").dumps(what)
        assert isinstance(found, bytes)
        return found

    def _replace(self, error: futures.BrokenExecutor) -> None:
        broken: Any = self._executor
        # the executor of all others in this process from now on, which therefore outlives the run
        self._executor, _ = broken.get_reusable_executor(
            max_workers=broken._max_workers, context=broken._context, timeout=broken._timeout,
            initializer=broken._initializer, initargs=broken._initargs, env=broken._env,
        )  # fmt: skip


class _RayWorkers(Workers):
    """The workers of the cluster that the module ``ray`` of this process is connected to."""

    def __init__(self, ray: Any) -> None:
        self._ray, self._own = ray, None
        self._there: dict[futures.Future[Any], Any] = {}
        # Ray would repeat work of a lost worker without counting it here
        self._run = ray.remote(max_retries=0)(_call)

    @property
    def count(self) -> int:
        if not self._ray.is_initialized():
            # what the first task would do otherwise
            self._ray.init()
        return max(1, int(self._ray.cluster_resources().get("CPU", 1)))

    def pickled(self, what: object) -> bytes:
        found = self._ray.cloudpickle.dumps(what)
        assert isinstance(found, bytes)
        return found

    def _submit(self, work: Work) -> futures.Future[Any]:
        there = self._run.remote(*work)
        ended: futures.Future[Any] = there.future()
        self._there[ended] = there
        return ended

    def _result(self, future: futures.Future[Any]) -> Any:
        del self._there[future]
        try:
            return future.result()
        except self._ray.exceptions.RayTaskError as error:
            # what the work raised, without Ray's account of it
            raise error.cause from None
        except self._ray.exceptions.RayError as error:
            raise Lost from error

    def _cancel(self, future: futures.Future[Any]) -> None:
        self._ray.cancel(self._there.pop(future))


def _call(function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    """One unit of work, at a worker."""
    return function(*arguments)


class _DaskWorkers(Workers):
    """The workers behind a Dask client.

    The client's own executor never finishes work that is cancelled, for example by a restarted
    scheduler.
    """

    def __init__(self, client: Any) -> None:
        self._client = client
        self._there: dict[futures.Future[Any], Any] = {}
        self._own = None

    @property
    def count(self) -> int:
        return max(1, int(sum(self._client.nthreads().values())))

    def pickled(self, what: object) -> bytes:
        # what is defined in a notebook or a script goes along whole
        import cloudpickle

        found = cloudpickle.dumps(what)
        assert isinstance(found, bytes)
        return found

    def _submit(self, work: Work) -> futures.Future[Any]:
        function, arguments = work
        # what is asked for again is to be made again
        there = self._client.submit(function, *arguments, pure=False)
        ended: futures.Future[Any] = futures.Future()
        self._there[ended] = there
        there.add_done_callback(ended.set_result)
        return ended

    def _result(self, future: futures.Future[Any]) -> Any:
        there = self._there.pop(future)
        try:
            return there.result()
        except Exception as error:
            # what the work raises makes it an error; of Dask's own errors that is one that says that
            # the workers died of it, or were thought to
            of_dask = type(error).__module__.partition(".")[0] == "distributed"
            if there.status == "error" and not of_dask:
                raise
            raise Lost from error

    def _cancel(self, future: futures.Future[Any]) -> None:
        self._there.pop(future).cancel()


# runs that this process has read, newest last
_OPENED: dict[bytes, _gumption.Parts] = {}


def _opened(run: bytes) -> _gumption.Parts:
    """The run, read once in each process."""
    found = _OPENED.get(run)
    if found is None:
        model, options = pickle.loads(run)
        found = model._parts(options)
        while len(_OPENED) > 3:
            # another thread may have done so
            _OPENED.pop(next(iter(_OPENED), b""), None)
        _OPENED[run] = found
    return found


def _part(run: bytes, pass_: bytes, start: int, end: int) -> bytes:
    """A part, as a worker makes it."""
    return _opened(run).part(pass_, start, end)


def _pieces(missing: Sequence[tuple[int, int]], length: int) -> Iterator[tuple[int, int]]:
    """Ranges cut at the multiples of a length."""
    for start, end in missing:
        while start < end:
            stop = min((start // length + 1) * length, end)
            yield start, stop
            start = stop


def _missing(there: Sequence[tuple[int, int]], blocks: int) -> list[tuple[int, int]]:
    """The missing ranges of blocks."""
    found, next_ = [], 0
    for start, end in [*sorted(there), (blocks, blocks)]:
        if start > next_:
            found.append((next_, start))
        next_ = max(next_, end)
    return found


def run_on(
    model: Model,
    options: dict[str, Any],
    executor: Any,
    *,
    parts: int | None = None,
    resume: str | os.PathLike[str] | None = None,
    with_quantiles: bool = False,
    told: Callable[[int], object] | None = None,
) -> _gumption.Run:
    """Makes a run with an executor.

    Parameters
    ----------
    model, options : Model, dict
        The run.
    executor : concurrent.futures.Executor, distributed.Client or the module ray
        Makes the parts.
    parts : int, optional
        Number of parts of each pass.
    resume : path-like, optional
        A folder in which parts are kept and from which existing parts are taken.
    with_quantiles : bool
        Whether to compute the quantiles of a result file as well.
    told : callable, optional
        Called with the number of completed trials, over all passes.
    """
    if resume is not None:
        model._refuse_function("resume")
        resume = os.fspath(resume)
    # a worker takes one part at a time: more threads would get into the way of other workers
    options = {"threads": 1, **options}
    here = model._parts(options)
    blocks = here.blocks
    with Workers.of(executor) as workers:
        run = workers.pickled((model, options))
        progress = _Progress(here.trials_of_block, told)
        pass_ = here.first()
        while True:
            kept: list[tuple[str, int, int]] = []
            if resume is not None:
                pass_, kept = here.kept(resume)
            length = _length(blocks, parts, workers.count)
            missing = _missing([(start, end) for _, start, end in kept], blocks)
            work: Iterator[Work] = (
                (_part, (run, pass_, start, end)) for start, end in _pieces(missing, length)
            )
            keep = None if resume is None else functools.partial(here.keep, resume)
            made = _made(kept, workers.done(work), keep, progress)
            with closing(made):
                merged = here.merge(pass_, made, with_quantiles)
            if isinstance(merged, _gumption.Run):
                return merged
            pass_ = merged
            if resume is not None:
                here.go_on(resume, pass_)


def _length(blocks: int, parts: int | None, workers: int) -> int:
    """Number of blocks of a part."""
    if parts is not None:
        return max(1, -(-blocks // parts))
    usual = -(-blocks // max(FEWEST_PARTS, PARTS_OF_WORKER * workers))
    return min(max(usual, FEWEST_BLOCKS), MOST_BLOCKS)


class _Progress:
    """Reports the number of completed trials."""

    def __init__(self, trials_of_block: float, told: Callable[[int], object] | None) -> None:
        self._rate, self._told, self._blocks = trials_of_block, told, 0

    def add(self, start: int, end: int) -> None:
        self._blocks += end - start
        if self._told is not None:
            self._told(round(self._blocks * self._rate))


def _made(
    kept: Sequence[tuple[str, int, int]],
    done: Generator[tuple[Work, bytes], None, None],
    keep: Callable[[bytes], object] | None,
    progress: _Progress,
) -> Generator[bytes, None, None]:
    """The parts of a pass in order of completion, existing ones first."""
    for path, start, end in kept:
        with open(path, "rb") as file:
            yield file.read()
        progress.add(start, end)
    with closing(done):
        for (_, (_, _, start, end)), part in done:
            if keep is not None:
                keep(part)
            yield part
            progress.add(start, end)


def _draws(case: bytes, threads: int, start: int, end: int) -> bytes:
    """Some draws of a blind test, as a worker makes them."""
    text, held, options = pickle.loads(case)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "draws")
        share = ["--share", f"{start}..{end}", "--partial", file, "--threads", str(threads)]
        called(["gap-check", "-", *options, *share, "--quiet"], None, text, held)
        with open(file, "rb") as made:
            return made.read()


def drawn_on(
    text: str,
    held: Sequence[tuple[str, bytes]],
    options: Sequence[str],
    draws: int,
    threads: int,
    executor: Any,
) -> list[bytes]:
    """The draws of a blind test, made with an executor, as the files of ``gap-check --partial``."""
    with Workers.of(executor) as workers:
        case = workers.pickled((text, list(held), list(options)))
        length = max(1, -(-draws // (PARTS_OF_WORKER * workers.count)))
        work: Iterator[Work] = (
            (_draws, (case, threads, start, end)) for start, end in _pieces([(0, draws)], length)
        )
        with closing(workers.done(work)) as done:
            return [part for _, part in done]
