#!/usr/bin/python3
"""axiscal-publish against a real Samba server: samba_share.py PROGRAM-FOLDER SENTENCE

Each function is a test. Nothing is slept for: every wait is for a condition and has a deadline. What this computer cannot do
is a failure unless AXISCAL_MAY_SKIP names samba (then exit 77).
"""
import contextlib
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import samba_server
from samba_server import Site, Skip, expect, run, wait_until

PROGRAMS = Path(sys.argv[1])
PROGRAM = PROGRAMS / "axiscal-publish"
THREE_FILES = ("certificate.csv", "certificate.json", "certificate.pdf")
sentences = {}


def sentence(name):
    def register(function):
        sentences[name] = function
        return function
    return register


@sentence("ResultsArriveEncryptedWithReceipts")
def arrive():
    with Site(PROGRAM) as site:
        site.samba.start()
        site.publish()
        site.stage("run-1", names=THREE_FILES)
        site.stage("run 2".replace(" ", "_"), size=3_000_001, names=("raw.bin", "a b#%ü.txt"))
        site.expect_all_published()
        session = run("smbstatus", "-s", site.samba.conf, "-b")
        expect("SMB3_11" in session and "AES-" in session, f"the session is not SMB 3 with encryption: {session}")
        receipt = site.publisher.published()[0]
        expect(receipt["folder"] == site.samba.url + "/run-1", receipt)


@sentence("AWrongPasswordWaitsAndTheRightOneNeedsNoRestart")
def wrong_password():
    with Site(PROGRAM) as site:
        site.samba.start()
        site.give_account("guessed")
        site.stage("run-1")
        site.publish()
        reason = site.publisher.waits_because("refuses the account")
        expect('"games"' in reason and "guessed" not in reason, reason)
        expect(site.on_share() == {}, "a guest wrote")
        site.give_account(samba_server.PASSWORD)
        site.expect_all_published()


@sentence("AWrongPasswordIsTriedOnceByEachHand")
def wrong_password_of_two_hands():
    """A server counts tries, and locks the account after some."""
    for results, most in ((1, 1), (20, 2)):
        with Site(PROGRAM) as site:
            site.samba.start()
            site.give_account("guessed")
            for number in range(results):
                site.stage(f"run-{number:02}")
            words = [PROGRAM, "--outbox", site.outbox, "--to", site.samba.url, "--credentials", site.account, "--once"]
            done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=90, check=False)
            expect(done.returncode == 1 and len(site.waiting()) == results, f"{done.returncode}: {done.stderr}")
            tries = (site.samba.home / "smbd.log").read_text(errors="replace").count("FAILED with error NT_STATUS_WRONG_PASSWORD")
            expect(1 <= tries <= most, f"{results} results: {tries} tries of a wrong password")


@sentence("AnAccountThatOthersMayReadIsRefused")
def wide_account():
    with Site(PROGRAM) as site:
        site.samba.start()
        site.account.chmod(0o640)
        site.stage("run-1")
        site.publish()
        site.publisher.waits_because(f"chmod 600 {site.account}")
        site.account.chmod(0o600)
        site.expect_all_published()


@sentence("AMissingShareOrFolderIsWaitedFor")
def share_missing():
    with Site(PROGRAM) as site:
        site.samba.shares = ["other"]
        site.samba.configure()
        site.samba.start()
        site.stage("run-1")
        site.publish(to=site.samba.url + "/axis tests")
        site.publisher.waits_because("no such share")
        site.samba.shares = ["other", "results"]
        site.samba.reload()
        share = site.samba.share
        expect(not list(share.iterdir()), "the folder was made")
        site.samba.share = share / "axis tests"
        site.samba.share.mkdir()
        shutil.chown(site.samba.share, samba_server.USER)
        site.expect_all_published()


@sentence("AServerThatIsNotThereIsWaitedForWithAllResults")
def no_server():
    with Site(PROGRAM) as site:
        for number in range(20):
            site.stage(f"run-{number}")
        site.publish()
        site.publisher.waits_because("no SMB server answers")
        expect(len(site.waiting()) == 20, "the queue is whole")
        site.samba.start()
        site.expect_all_published()


@sentence("AServerKilledInMidWriteLosesNothing")
def server_killed():
    with Site(PROGRAM) as site:
        site.samba.start()
        site.publish()
        site.stage("run-1")
        caught = site.catch_in_mid_write(site.samba.freeze, site.samba.thaw)
        site.samba.kill()
        site.publisher.waits_because("smb://")
        expect(caught in site.waiting(), "the result left the outbox")
        site.expect_whole()
        site.stage("run-2")
        site.samba.start()
        site.expect_all_published()


@sentence("AServerFrozenInMidWriteLosesNothing")
def server_frozen():
    with Site(PROGRAM) as site:
        site.samba.start()
        site.publish()
        caught = site.catch_in_mid_write(site.samba.freeze, site.samba.thaw)
        site.publisher.waits_because("does not answer in time")
        expect(caught in site.waiting(), "the result left the outbox")
        site.expect_whole()
        site.stage("run-2")
        site.samba.thaw()
        site.expect_all_published()


@sentence("APublisherKilledInMidWriteSweepsItsHalfFile")
def publisher_killed():
    with Site(PROGRAM) as site:
        site.samba.start()
        site.publish()
        caught = site.catch_in_mid_write(lambda: site.publisher.process.send_signal(signal.SIGSTOP),
                                         lambda: site.publisher.process.send_signal(signal.SIGCONT))
        site.publisher.end(signal.SIGKILL)
        expect(caught in site.waiting() and site.parts(), "the half file lies there")
        site.expect_whole()
        site.publish()
        site.expect_all_published()


@sentence("AFullShareIsWaitedFor")
def share_full():
    samba_server.own_namespaces(samba_server.NEW_MOUNTS)
    run("mount", "--make-rprivate", "/")
    with Site(PROGRAM) as site:
        run("mount", "-t", "tmpfs", "-o", "size=1m,mode=0777", "tmpfs", site.samba.share)
        with contextlib.ExitStack() as later:
            later.callback(run, "umount", "-l", site.samba.share)
            site.samba.start()
            in_the_way = site.samba.share / "somebody"
            in_the_way.write_bytes(bytes(900_000))
            site.stage("run-1", size=300_000)
            site.stage("run-2", size=100)
            site.publish()
            site.publisher.waits_because("the share is full")
            expect("run-1" in site.waiting(), "a result left the outbox")
            site.expect_whole()
            in_the_way.unlink()
            site.expect_all_published()
            site.publisher.end()


@sentence("ACutNetworkLosesNothing")
def network_cut():
    samba_server.own_namespaces(samba_server.NEW_NETWORK)
    holder = subprocess.Popen(["unshare", "-n", "cat"], stdin=subprocess.PIPE, preexec_fn=samba_server.die_with_parent)
    there = ["nsenter", "-t", str(holder.pid), "-n"]
    own = os.readlink("/proc/self/ns/net")
    wait_until("the server's network", lambda: os.readlink(f"/proc/{holder.pid}/ns/net") != own)
    try:
        made = subprocess.run(["ip", "link", "add", "v0", "type", "veth", "peer", "name", "v1", "netns", str(holder.pid)],
                              capture_output=True, text=True, check=False)
        if made.returncode != 0:
            raise Skip(f"this kernel has no veth: {made.stderr}")
        for enter, name, address in (([], "v0", "10.97.0.1/24"), (there, "v1", "10.97.0.2/24")):
            run(*enter, "ip", "address", "add", address, "dev", name)
            for link in ("lo", name):
                run(*enter, "ip", "link", "set", link, "up")
        with Site(PROGRAM, address="10.97.0.2", interface="v1", enter=there) as site:
            site.samba.start()
            site.publish()
            site.stage("run-1")
            wait_until("the first one is published", lambda: not site.waiting())
            caught = site.catch_in_mid_write(lambda: run(*there, "ip", "link", "set", "v1", "down"),
                                             lambda: run(*there, "ip", "link", "set", "v1", "up"))
            site.publisher.waits_because("smb://")
            expect(caught in site.waiting(), "the result left the outbox")
            site.expect_whole()
            for number in range(2, 12):
                site.stage(f"run-{number}")
            run(*there, "ip", "link", "set", "v1", "up")
            site.expect_all_published()
    finally:
        holder.kill()
        holder.wait()


@contextlib.contextmanager
def held_open(site, path):
    """Somebody's smbclient has this file of the share open."""
    holder = subprocess.Popen(
        ["smbclient", "-s", site.samba.conf, "-p", str(site.samba.port), "-U", f"games%{samba_server.PASSWORD}",
         "//127.0.0.1/results"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        preexec_fn=samba_server.die_with_parent)
    try:
        holder.stdin.write(f"open {path}\n")
        holder.stdin.flush()
        # Only what is open in full stands there with its name: our own .part has another one.
        wait_until(f"{path} is held open", lambda: f" {path} " in run("smbstatus", "-s", site.samba.conf, "-L"))
        yield
    finally:
        holder.kill()
        holder.wait()


def somebody_took_run_1(site):
    """Somebody else's file under the name of a result's, which must stay as it is."""
    theirs = site.folder / "theirs"
    theirs.write_bytes(b"somebody else's")
    site.samba.client(f"mkdir run-1; put {theirs} run-1/certificate.json")
    site.foreign = site.on_share()


@sentence("ANameThatSomebodyHoldsOpenIsNeverReplaced")
def name_held():
    with Site(PROGRAM) as site:
        site.samba.start()
        somebody_took_run_1(site)
        with held_open(site, "run-1/certificate.json"):
            site.stage("run-1")
            site.publish()
            site.expect_all_published()
            expect(site.publisher.published()[0]["folder"].endswith("/run-1-2"), site.publisher.said)


def take_name_in_mid_write(meanwhile):
    """The folder is chosen and the file half written when somebody makes a file of its final name there, and has it open or not
    while ours comes to its end: `meanwhile` is a context for that. The publisher is the one that stands still, for a frozen
    server would not take the foreign file either."""
    with Site(PROGRAM) as site:
        site.samba.start()
        site.publish("--timeout", "60")  # standing still is no lost share here
        caught = site.catch_in_mid_write(lambda: site.publisher.process.send_signal(signal.SIGSTOP),
                                         lambda: site.publisher.process.send_signal(signal.SIGCONT))
        name = f"{caught}/raw.bin"
        theirs = site.folder / "theirs"
        theirs.write_bytes(b"somebody else's")
        site.samba.client(f"put {theirs} {name}")
        site.foreign = {name: hashlib.sha256(b"somebody else's").hexdigest()}
        with meanwhile(site, name):
            site.publisher.process.send_signal(signal.SIGCONT)
            site.expect_all_published()  # theirs as it was, ours whole, the receipt with our digest
        last = site.publisher.published(len(site.staged))[-1]
        expect(last["folder"] == f"{site.samba.url}/{caught}-2", f"it lies in {last['folder']}")
        expect(not site.publisher.reasons(), f"it waited: {site.publisher.reasons()}")


@sentence("ANameTakenWhileItsFileIsOnTheWayIsNeverReplaced")
def name_taken():
    take_name_in_mid_write(lambda *_: contextlib.nullcontext())


@sentence("ANameTakenAndHeldOpenWhileItsFileIsOnTheWayIsNeverReplaced")
def name_taken_and_held():
    take_name_in_mid_write(held_open)


@sentence("AShareOfANamespaceTakesResultsAndReplacesNothing")
def dfs():
    """Before each call that names a file the library asks such a share where the path leads."""
    with Site(PROGRAM) as site:
        site.samba.more = "  host msdfs = yes\n  msdfs root = yes"
        site.samba.configure()
        site.samba.start()
        somebody_took_run_1(site)
        for run_id in ("run-1", "run-2"):
            site.stage(run_id)
        site.publish()
        site.expect_all_published()
        expect(not site.publisher.reasons(), f"it waited: {site.publisher.reasons()}")


@sentence("AServerOfSmb1IsRefused")
def smb1():
    with Site(PROGRAM) as site:
        site.samba.more = "  server min protocol = NT1\n  server max protocol = NT1\n  server smb encrypt = off\n  ntlm auth = yes"
        site.samba.configure()
        site.samba.start()
        site.stage("run-1")
        site.publish()
        site.publisher.waits_because("smb://")
        expect(site.on_share() == {} and site.waiting() == ["run-1"], "SMB 1 was spoken")
        # The same server, young again: it was the protocol and nothing else.
        site.samba.kill()
        site.samba.more = ""
        site.samba.configure()
        site.samba.start()
        site.expect_all_published()


@sentence("AServerWithoutEncryptionIsRefusedUnlessAskedOnly")
def no_encryption():
    with Site(PROGRAM) as site:
        site.samba.more = "  server smb encrypt = off\n  server signing = mandatory"
        site.samba.configure()
        site.samba.start()
        site.stage("run-1")
        site.publish()
        site.publisher.waits_because("does not speak SMB 3 with encryption")
        expect(not list(site.samba.share.iterdir()) and site.waiting(), "it went in clear text")
        site.publisher.end()
        station = site.folder / "station.toml"
        station.write_text(Path(__file__).parents[3].joinpath("config/station.example.toml").read_text())
        text = station.read_text()
        for old, new in (('# state_directory = "/var/lib/axiscal"', f'state_directory = "{site.outbox.parent}"'),
                         ('destination = "/mnt/quality/axiscal"', f'destination = "{site.samba.url}"'),
                         ('# credentials = "/etc/axiscal/share.credentials"', f'credentials = "{site.account}"'),
                         ('# encryption = "required"', 'encryption = "asked"')):
            expect(old in text, f"the example has no {old}")
            text = text.replace(old, new)
        station.write_text(text)
        site.publisher.process = subprocess.Popen([PROGRAM, "--config", station], stderr=subprocess.DEVNULL,
                                                  preexec_fn=samba_server.die_with_parent)
        site.expect_all_published()
        session = run("smbstatus", "-s", site.samba.conf, "-b")
        expect("SMB3_11" in session and "AES-" in session.split("SMB3_11")[1], f"the session is not signed: {session}")


@sentence("ASecondHandThatIsKilledLeavesItsResultsToTheFirst")
def second_hand_killed():
    with Site(PROGRAM) as site:
        site.samba.start()
        for number in range(400):
            site.stage(f"run-{number:03}")
        site.publish()
        publisher = site.publisher.process.pid
        children = Path(f"/proc/{publisher}/task/{publisher}/children")
        hand = int(wait_until("a second hand helps", lambda: children.read_text().split())[0])
        os.kill(hand, signal.SIGKILL)
        expect(site.waiting(), "all was published before the second hand was killed")
        site.expect_all_published()
        expect(not site.publisher.reasons(), f"{site.publisher.reasons()}")


@sentence("ManyResultsInOneGo")
def many():
    count = int(os.environ.get("AXISCAL_SAMBA_RESULTS", "1000"))
    with Site(PROGRAM) as site:
        site.samba.start()
        for number in range(count):
            site.stage(f"run-{number:04}")
        site.publish()
        site.expect_all_published()
        expect(len(site.publisher.published(count)) == count, "each was told once")
        expect(not site.publisher.reasons(), f"{site.publisher.reasons()}")
        expect(site.samba.sessions_begun() == 2, f"{site.samba.sessions_begun()} sessions for two hands")
        print(f"{count} results of 20 KB published, each read back and equal")


def main():
    name = sys.argv[2]
    try:
        samba_server.require()
        sentences[name]()
    except Skip as missing:
        print(f"cannot run here: {missing}")
        return 77 if "samba" in os.environ.get("AXISCAL_MAY_SKIP", "").split(",") else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
