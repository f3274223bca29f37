"""What the station shows to Prometheus, in mid-run and when every instrument has gone."""

import http.client
import re
import signal
import subprocess
import sys
from pathlib import Path

import bench
from bench import SOURCE, expect, sentence

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
import promtool

LATER = 4102444800  # the end of 2099-12-31 in UTC: due_on of every instrument of the bench
VALUE = re.compile(r"^(axiscal_channel_(?:displacement_metres|temperature_celsius|pressure_pascals|\w+_ratio|angle_radians)"
                   r"\{.*\}) ", re.M)
program = None


def scrape(b):
    """As Prometheus does it: over TCP, without a token."""
    door = http.client.HTTPConnection("127.0.0.1", b.station["console"]["port"], timeout=10)
    try:
        door.request("GET", "/metrics")
        answer = door.getresponse()
        kind = answer.headers["Content-Type"]
        expect(answer.status == 200 and kind == "text/plain; version=0.0.4; charset=utf-8", f"{answer.status} {kind}")
        return answer.read().decode("utf-8")
    finally:
        door.close()


def accepted(text):
    """promtool reads it, and has no complaint about names and units. Gives the text back."""
    judged = subprocess.run([program, "check", "metrics"], input=text, capture_output=True, text=True, timeout=60, check=False)
    said = judged.stdout + judged.stderr
    expect(judged.returncode == 0 and not said, f"promtool, exit {judged.returncode}: {said}\n{text}")
    return text


def has(text, line):
    expect(line in text.splitlines(), f"there is no line {line} in\n{text}")


@sentence("MetricsAreWhatPromtoolAccepts")
def metrics(b):
    b.station["console"]["port"] = bench.free_port()
    b.station["station"]["name"] = 'bay "3" C:\\axiscal'
    b.station["axis"]["air"]["oldest"] = "2 s"  # so that a value is soon too old
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    text = accepted(scrape(b))
    has(text, 'axiscal_station_info{station="bay \\"3\\" C:\\\\axiscal",axis="X",kind="linear"} 1')
    has(text, "axiscal_run_open 1")
    has(text, "axiscal_run_points_durable 3")
    has(text, "axiscal_run_points_planned 20")
    has(text, 'axiscal_instrument_state{instrument="laser",state="available"} 1')
    has(text, f'axiscal_instrument_certificate_expiry_timestamp_seconds{{instrument="laser"}} {LATER}')
    expect('axiscal_run_fault{fault="beam_lost"} 0' in text, text)

    def every_value_is_shown():
        good = [one for one in b.status()["channels"] if one["value"] is not None]
        return len(good) == len(VALUE.findall(scrape(b)))

    bench.wait_until("each good value has its line", every_value_is_shown, 30)
    b.end("axiscal-simulate", signal.SIGKILL)
    bench.wait_until("no value is good any more", lambda: not VALUE.search(scrape(b)), 120)
    text = accepted(scrape(b))
    expect('quality="good"} 1' not in text, text)
    has(text, 'axiscal_channel_quality{instrument="air",channel="air pressure",quality="stale"} 1')


if __name__ == "__main__":
    program = promtool.require(SOURCE)
    bench.main()
