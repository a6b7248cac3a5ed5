"""Runs one program and says what it cost."""

import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time


def _kill(group):
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass  # it ended by itself in this moment


_running = set()
_ended = threading.Event()


def end_all():
    """Ends what runs, from another thread: each of these `run` raises InterruptedError, and so does any from now."""
    _ended.set()
    for group in list(_running):
        _kill(group)


def run(command, limit):
    """Wall and CPU seconds of the whole process, its peak memory in bytes, its exit code and what it printed.

    After `limit` seconds it is ended, and "limit_hit" says so. The peak is the kernel's (ru_maxrss); it can't be
    less than what this small Python itself holds, some 20 MB. When memory runs out, this program is the one to go.
    """
    load = os.getloadavg()[0]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        start = time.perf_counter()
        child = subprocess.Popen(command, stdout=out, stderr=err, start_new_session=True)
        timer = threading.Timer(min(limit, threading.TIMEOUT_MAX), _kill, [child.pid])
        timer.start()
        try:
            _running.add(child.pid)
            if _ended.is_set():
                raise InterruptedError
            pathlib.Path(f"/proc/{child.pid}/oom_score_adj").write_text("1000")
            _, status, usage = os.wait4(child.pid, 0)
        except BaseException:  # interrupted: nothing is left running
            _kill(child.pid)
            raise
        finally:
            timer.cancel()
            _running.discard(child.pid)
        if _ended.is_set():
            raise InterruptedError
        wall = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak_memory": usage.ru_maxrss * 1024,
                "exit_code": child.returncode, "limit_hit": child.returncode == -signal.SIGKILL and wall >= limit,
                "load_before": load, "stdout": out.read().decode(), "stderr": err.read().decode(errors="replace")}
