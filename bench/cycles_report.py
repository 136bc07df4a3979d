"""What bench/cycles found: cycles_report.py FOLDER REFERENCE ROUNDS SAMPLES... prints a table and writes FOLDER/cycles.json."""
import array
import json
import os
import statistics
import sys

RENDERERS = ("minirt", "cycles")
EPSILON = 0.01  # keeps relMSE finite where the reference is black
OUTLIERS = 0.001  # share of the values, the largest, without which relMSE is given too: a single spark can decide it


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n", path
        file.readline()
        assert float(file.readline()) < 0, path
        values = array.array("f")
        values.frombytes(file.read())
    if sys.byteorder == "big":
        values.byteswap()
    return values


def rel_mse(picture, reference):
    """Over all pixels and channels; and without the outliers."""
    errors = sorted((x - r) ** 2 / (r * r + EPSILON) for x, r in zip(picture, reference))
    kept = errors[: len(errors) - int(len(errors) * OUTLIERS)]
    return sum(errors) / len(errors), sum(kept) / len(kept)


def read_times(path):
    with open(path, encoding="ascii") as file:
        return {int(count): float(seconds) for count, seconds in map(str.split, file)}


def seconds_a_sample(times):
    """The slope of a line through (samples, seconds): what is done once a picture is in its other end."""
    n, x, y = len(times), statistics.mean(times), statistics.mean(times.values())
    if n < 2:
        return y / x
    return sum((a - x) * (b - y) for a, b in times.items()) / sum((a - x) ** 2 for a in times)


def spread(values):
    return {"median": statistics.median(values), "low": min(values), "high": max(values)}


def measure(folder, renderer, reference, rounds, counts):
    truth = read_pfm(os.path.join(folder, f"{renderer}_reference_{reference}.pfm"))
    result = {"seconds_a_sample": [], "error_times_samples": [], "rel_mse": {count: [] for count in counts}}
    result["seconds"] = {count: [] for count in counts}
    for round_ in range(1, rounds + 1):
        prefix = os.path.join(folder, f"{renderer}_{round_}")
        times = read_times(prefix + ".times")
        products = []
        for count in counts:
            errors = rel_mse(read_pfm(f"{prefix}_{count}.pfm"), truth)
            result["rel_mse"][count].append(errors)
            result["seconds"][count].append(times[count])
            products.append(errors[1] / (1 / count + 1 / reference))  # the reference has noise of its own
        result["seconds_a_sample"].append(seconds_a_sample(times))
        result["error_times_samples"].append(statistics.mean(products))
    result["error_times_seconds"] = [e * s for e, s in zip(result["error_times_samples"], result["seconds_a_sample"])]
    return result


def summary(measured):
    def of(count):
        full, kept = zip(*measured["rel_mse"][count])
        return {"samples": count, "seconds": spread(measured["seconds"][count]), "rel_mse": spread(full), "rel_mse_without_outliers": spread(kept)}

    names = ("seconds_a_sample", "error_times_samples", "error_times_seconds")
    return {**{name: spread(measured[name]) for name in names}, "pictures": [of(count) for count in measured["seconds"]]}


def main(folder, reference, rounds, *counts):
    reference, rounds, counts = int(reference), int(rounds), [int(count) for count in counts]
    measured = {one: measure(folder, one, reference, rounds, counts) for one in RENDERERS}
    truths = [read_pfm(os.path.join(folder, f"{one}_reference_{reference}.pfm")) for one in RENDERERS]
    between = rel_mse(*truths)
    means = [sum(truth) / len(truth) for truth in truths]
    expected = sum(statistics.median(measured[one]["error_times_samples"]) for one in RENDERERS) / reference
    ratio = spread([m / c for m, c in zip(*(measured[one]["error_times_seconds"] for one in RENDERERS))])
    report = {"references": {"samples": reference, "rel_mse": between[0], "rel_mse_without_outliers": between[1], "expected_of_noise": expected, "means": means}}
    report.update({one: summary(measured[one]) for one in RENDERERS}, time_of_minirt_over_cycles_at_equal_noise=ratio)
    with open(os.path.join(folder, "cycles.json"), "w", encoding="ascii") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    print(f"References of {reference} samples: relMSE between them {between[0]:.3g}, without outliers {between[1]:.3g}, of which their noise "
          f"explains {expected:.3g}; means {means[0]:.5g} and {means[1]:.5g}")
    print(f"{'':8} {'samples':>8} {'seconds':>9} {'relMSE':>10} {'without outliers':>17}")
    for one in RENDERERS:
        for row in report[one]["pictures"]:
            print(f"{one:8} {row['samples']:8} {row['seconds']['median']:9.3f} {row['rel_mse']['median']:10.4g} "
                  f"{row['rel_mse_without_outliers']['median']:17.4g}")
    for one in RENDERERS:
        s = report[one]
        print(f"{one}: {s['seconds_a_sample']['median'] * 1e3:.1f} ms a sample, error x samples {s['error_times_samples']['median']:.4g}")
    print(f"Time of minirt at the noise of Cycles: {ratio['median']:.2f} of its time ({ratio['low']:.2f}-{ratio['high']:.2f})")


main(*sys.argv[1:])
