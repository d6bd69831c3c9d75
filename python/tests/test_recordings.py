"""Recordings as arrays: oscillations and transient signals."""

from __future__ import annotations

import pickle

import gumption as gu
import numpy as np
import pandas as pd
import pytest

RATE = 1000.0
T = np.arange(2000) / RATE
SINE = 2.0 * np.cos(2 * np.pi * 16 * T + 0.3)
PULSE = np.where((T > 1.0) & (T < 1.1), np.sin(np.pi * (T - 1.0) / 0.1) ** 2, 0.0)


def recipe(**channel: object) -> dict[str, object]:
    return {
        "recordings": {"run": {"sampling_rate": RATE}},
        "channels": {"a": {"column": 1, "unit": "V", **channel}},
    }


def waveform(**more: object) -> dict[str, object]:
    step = {"step": "waveform", "noise": {"standard_uncertainty": 0.001}, **more}
    return {**recipe(steps=[step]), "trials": 0}


@pytest.mark.parametrize("values", [SINE, SINE[:, None], {"v": SINE}, pd.DataFrame({"v": SINE})])
def test_an_oscillation(values: object) -> None:
    found = gu.observe({**recipe(), "frequency": 16}, {"run": values})
    component = found["rows"][0]["channels"]["a"]["components"][0]
    # exact values: rounding of 2000 samples
    assert component["amplitude"]["value"] == pytest.approx(2.0, abs=1e-9)
    assert component["phase"]["value"] == pytest.approx(np.degrees(0.3), abs=1e-6)


def test_a_corrected_signal_by_numpy() -> None:
    """u by the law of propagation against one inverse transform for each point and part."""
    f = np.array([0.0, 20.0, 50.0, 120.0, 600.0])
    modulus = np.array([2.0, 2.01, 2.05, 2.2, 2.2])
    u = 0.01 * modulus
    response = {
        "x": {"unit": "Hz", "values": f.tolist()},
        "y": {"complex": {
            "modulus": {"unit": "V/N", "values": modulus.tolist(), "standard_uncertainty": u.tolist()},
            "phase": {"unit": "deg", "values": [0.0] * 5, "standard_uncertainty": 1e-12},
        }},
    }  # fmt: skip
    found = gu.observe(
        waveform(response=response, unit="N", low_pass="none", quantities=["maximum"]), {"run": PULSE}
    )
    of = found["rows"][0]["waveforms"]["a"]
    lines = np.fft.rfftfreq(2000, 1 / RATE)
    h = np.interp(lines, f, modulus)
    spectrum = np.fft.rfft(PULSE) / h
    expected = np.fft.irfft(spectrum, 2000)
    variance = 0.001**2 / 2000 * (np.concatenate([h, h[-2:0:-1]]) ** -2.0).sum() + np.zeros(2000)
    for point in range(5):
        hat = np.interp(lines, f, np.eye(5)[point])
        variance += (u[point] * np.fft.irfft(-spectrum * hat / h, 2000)) ** 2
    # rounding of transforms of values of the size of one
    assert np.allclose(of["values"], expected, rtol=0, atol=1e-13)
    assert np.allclose(of["standard_uncertainties"], np.sqrt(variance), rtol=1e-9, atol=0)
    frame = found.to_pandas()
    assert list(frame.columns) == ["t [s]", "a [N]", "u_a [N]", "low_a [N]", "high_a [N]"]
    assert np.allclose(frame["a [N]"], expected, rtol=0, atol=1e-13)
    assert pickle.loads(pickle.dumps(found)) == found


def test_what_is_wrong_is_said() -> None:
    with pytest.raises(gu.ModelError, match="the recordings of the recipe are `run`"):
        gu.observe(waveform(), {"other": PULSE})
    with pytest.raises(gu.ModelError, match="give the recipe as a mapping"):
        gu.observe("recipe.json", {"run": PULSE})
    with pytest.raises(gu.ModelError, match="one or two dimensions"):
        gu.observe(waveform(), {"run": PULSE[:, None, None]})
    with pytest.raises(gu.ModelError, match="different lengths"):
        gu.observe(waveform(), {"run": {"v": PULSE, "w": PULSE[1:]}})
    with pytest.raises(gu.ModelError, match="nan|finite|number"):
        gu.observe(waveform(), {"run": np.where(T > 1, np.nan, PULSE)})
