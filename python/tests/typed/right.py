"""What type checkers accept, with the types that they find."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
import gumption as gu
from typing_extensions import assert_type

Array = npt.NDArray[np.float64]


@gu.model(inputs={"a": "V"}, outputs={"y": "V"}, conditions={"f": "Hz"})
def by_row(a: Any, f: Any) -> Any:
    return a * f


@gu.model(inputs={"a": "V"}, outputs={"y": "V"})
def alone(a: Any) -> Any:
    return 2 * a


m = alone(a=gu.normal(1, 0.1))
assert_type(m, gu.Model[float])
r = m.run(trials=1000)
assert_type(r, gu.Result[float])
assert_type(r["y"], gu.Output[float])
assert_type(r["y"].gum, gu.Gum[float])
u = r["y"].gum.standard_uncertainty
assert_type(u, float)
print(round(u, 3), f"{u:.3g}", r["y"].monte_carlo.median + 1)
assert_type(m.set(a=2).run()["y"].gum.dof, float)
assert_type(m.with_inputs(a=(1, 0.1)).run()["y"].gum.dof, float)

s = by_row(a=(1, 0.1), conditions={"f": [1.0, 2.0]}).run()
assert_type(s, gu.Result[Array])
assert_type(s["y"].monte_carlo.estimate, Array)
print(s["y"].gum.estimate[0], s["y"].gum.estimate.max())
assert_type(m.with_conditions({"f": [1]}).run()["y"].gum.estimate, Array)

x = gu.load("a.json").run()
assert_type(x["y"].gum.estimate, Any)
plain: gu.Model = gu.load("a.json")
either: gu.Result = r
wide: gu.Result[float | Array] = r
total: float = gu.from_dict({}).run()["y"].gum.estimate
assert_type(gu.from_dict({}, conditions={"f": [1]}).run()["y"].gum.estimate, Array)

b = gu.budgets(alone, a=(np.ones(3), 0.1))
assert_type(b["y"], gu.OutputBudgets)
assert_type(b.estimate, Array)
assert_type(b["y"].contributions["a"], Array)
by_name: Mapping[str, gu.OutputBudgets] = b
for name, of in b.items():
    print(name, of.expanded_uncertainty.max())

gu.normal(np.float64(1), np.int64(1), about="x", type="A", group="g", per="row", resolution=0.1)
gu.rectangular(lower=0, upper=1, semi_range=None, limits=(0, None))
gu.readings([1.0, 2.0], evaluation="bayesian", pooled={"std": 0.1, "dof": 9})
r.page()
