#!/usr/bin/env python3
"""Lays the hidden truth beside the certificate: join_truth.py CERTIFICATE TRUTH OUTPUT

Prints the table and writes the certificate with "truth" added. The daemon never sees the truth.
"""
import json
import sys

ORDER = ["A", "A_forward", "A_backward", "E", "E_forward", "E_backward", "M", "R", "R_forward", "R_backward", "B", "B_mean"]


def band(truth):
    """Largest and smallest value that the injected noise and the sensors' resolution explain."""
    if "bound" in truth:
        return truth["value"] - truth["bound"], truth["value"] + truth["bound"]
    return truth["low"], truth["high"]


def main():
    certificate_path, truth_path, output_path = sys.argv[1:4]
    with open(certificate_path, encoding="utf-8") as file:
        certificate = json.load(file)
    with open(truth_path, encoding="utf-8") as file:
        truth = json.load(file)
    print(f"\n{'parameter, µm':<14}{'certificate':>12}{'truth':>10}   expected")
    outside = []
    for key in ORDER:
        measured = certificate["parameters"].get(key, {}).get("value")
        hidden = truth["parameters"].get(key)
        if measured is None or hidden is None:
            continue
        low, high = band(hidden)
        inside = low <= measured <= high
        outside += [] if inside else [key]
        print(f"{key:<14}{measured * 1e3:>12.2f}{hidden['value'] * 1e3:>10.2f}   {low * 1e3:.2f} to {high * 1e3:.2f}{'' if inside else '   OUTSIDE'}")
    print()
    certificate["truth"] = truth
    with open(output_path, "w", encoding="utf-8") as file:
        json.dump(certificate, file, indent=1, ensure_ascii=False)
        file.write("\n")
    if outside:
        print("Outside what the injected noise explains:", ", ".join(outside), file=sys.stderr)
    return 1 if outside else 0


sys.exit(main())
