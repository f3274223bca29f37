#!/usr/bin/env python3
"""promtool lets each alert of docs/metrics.md ring, and end: metrics_alerts.py SOURCE_DIR

A missing promtool is a failure unless AXISCAL_MAY_SKIP names it (then exit 77)."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1])
sys.path.append(str(root / "tests/support"))
import promtool

DAY_S = 86400
DUE = "axiscal_instrument_certificate_expiry_timestamp_seconds"


def series(name, values, **labels):
    inside = ",".join(f'{key}="{value}"' for key, value in {"instance": "bay3", **labels}.items())
    return {"series": f"{name}{{{inside}}}", "values": values}


def rings(alert, minute, summary=None, **labels):
    """That it does at that minute; without a summary, that it does not."""
    told = [{"exp_labels": {"instance": "bay3", **labels}, "exp_annotations": {"summary": summary}}] if summary else []
    return {"eval_time": f"{minute}m", "alertname": alert, "exp_alerts": told}


def cases():
    """One minute a value; the clock of promtool begins at 1970."""
    share = "bay3: results wait for the share. 'axiscal status' names the reason."
    yield ([series("axiscal_outbox_alarm", "0x9 1x20 0x10")],
           [rings("AxiscalShareDown", 12), rings("AxiscalShareDown", 20, share), rings("AxiscalShareDown", 35)])
    beam = "bay3: the beam was lost in a run. Restore it, move to the datum and arm again."
    yield ([series("axiscal_run_fault", "0x9 1x9 0x10", fault="beam_lost"), series("axiscal_run_fault", "0x30", fault="datum_lost"),
            series("axiscal_run_fault", "1x30", fault="not_still")],
           [rings("AxiscalBeamLost", 5), rings("AxiscalBeamLost", 15, beam, fault="beam_lost"), rings("AxiscalBeamLost", 25)])
    due = "bay3: the certificate of laser  is due within 30 days."
    yield ([series(DUE, f"{29 * DAY_S}x100", instrument="laser"), series(DUE, f"{31 * DAY_S}x100", instrument="air")],
           [rings("AxiscalCertificateDue", 30), rings("AxiscalCertificateDue", 90, due, instrument="laser")])


def main():
    program = promtool.require(root)
    page = (root / "docs/metrics.md").read_text(encoding="utf-8")
    rules = re.search(r"^```yaml\n(groups:.*?)^```", page, re.M | re.S)[1]
    names = set(re.findall(r"alert: (\w+)", rules))
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "rules.yml").write_text(rules, encoding="utf-8")
        tests = [{"interval": "1m", "input_series": given, "alert_rule_test": wanted} for given, wanted in cases()]
        judged = {"rule_files": ["rules.yml"], "evaluation_interval": "1m", "tests": tests}
        (pathlib.Path(folder) / "tests.yml").write_text(json.dumps(judged), encoding="utf-8")  # JSON is YAML
        subprocess.run([program, "check", "rules", "rules.yml"], cwd=folder, check=True)
        subprocess.run([program, "test", "rules", "tests.yml"], cwd=folder, check=True)
    tried = {one["alertname"] for test in tests for one in test["alert_rule_test"] if one["exp_alerts"]}
    assert names == tried, f"alerts of the page that nothing lets ring, or the reverse: {names ^ tried}"
    print(f"{len(names)} alerts ring and end")


main()
