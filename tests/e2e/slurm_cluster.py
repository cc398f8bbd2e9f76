"""A Slurm of one controller and two nodes, all on this machine, without munge and cgroups.

Needs Debian's slurmctld, slurmd and slurm-client (scripts/setup slurm) and root, as which slurmd
runs jobs. Nothing of an installed cluster is touched: configuration, state and ports are its own.
"""

import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

CONFIG = """ClusterName=turnscan-test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CryptoType=crypto/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ReturnToService=2
SlurmdTimeout=10
MailProg=/bin/true
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={port1} CPUs={cpus} State=UNKNOWN
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={port2} CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


def why_not():
    """Why there can be no cluster here; empty where there can."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    missing = [name for name in ("slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol")
               if not shutil.which(name, path=path)]
    if missing:
        return f"Slurm is not installed (no {', '.join(missing)}): scripts/setup slurm"
    if os.geteuid() != 0:
        return "slurmd runs jobs as root only"
    return ""


def _free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Cluster:
    def __init__(self, cpus=2):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-slurm-"))
        (self.folder / "state").mkdir()
        host = socket.gethostname().split(".")[0]
        port, port1, port2 = _free_ports(3)
        config = self.folder / "slurm.conf"
        config.write_text(CONFIG.format(folder=self.folder, host=host, port=port, port1=port1,
                                        port2=port2, cpus=cpus))
        self.env = {**os.environ, "SLURM_CONF": str(config),
                    "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin"}
        self.daemons = {}
        try:
            self.start_controller()
            self.start_node("n1")
            self.start_node("n2")
            self.wait_for_idle_nodes()
        except BaseException:
            self.stop()
            raise

    def _start(self, name, *command):
        log = open(self.folder / f"{name}.out", "a")
        self.daemons[name] = subprocess.Popen(command, env=self.env, stdin=subprocess.DEVNULL,
                                              stdout=log, stderr=log, cwd=self.folder)
        log.close()

    def start_controller(self):
        self._start("slurmctld", "slurmctld", "-D")

    def start_node(self, name):
        (self.folder / f"spool-{name}").mkdir(exist_ok=True)
        self._start(name, "slurmd", "-D", "-N", name)

    def kill(self, name):
        """Of a node the daemon alone: what it had started goes on, as behind a broken network."""
        self.daemons[name].kill()
        self.daemons.pop(name).wait()

    def stop_daemon(self, name):
        process = self.daemons.pop(name)
        process.terminate()
        process.wait(timeout=30)

    def wait_for_idle_nodes(self):
        self.wait_for("two idle nodes", lambda: self.call("sinfo", "-h", "-t", "idle", "-o",
                                                          "%D").split() == ["2"])

    def call(self, *command):
        result = subprocess.run(command, env=self.env, text=True, capture_output=True, timeout=60)
        return result.stdout if result.returncode == 0 else ""

    def wait_for(self, what, condition, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(f"{what}: not within {seconds} s; see {self.folder}")
            time.sleep(0.2)

    def stop(self):
        self.call("scancel", "--full", "--me")
        for process in self.daemons.values():
            process.send_signal(signal.SIGTERM)
        for process in self.daemons.values():
            try:
                process.wait(timeout=15)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
