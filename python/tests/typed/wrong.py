"""What type checkers find: an error in each line with a mark."""

import gumption as gu


@gu.model(inputs={"a": "V"}, outputs={"y": "V"})
def alone(a: float) -> float:
    return 2 * a


gu.normal(1, sdt=0.1)  # error
gu.normal(1, 0.1, about=5)  # error
gu.normal(1, 0.1, type="C")  # error
gu.exponential(1, std=0.1)  # error
gu.components(1, {}, evidence=[1.0])  # error
b = gu.budgets(alone, a=1)
b["y"].estimated  # error
b.estimated  # error
u: str = alone(a=1).run()["y"].gum.estimate  # error
v: float = alone(a=1, conditions={"f": [1]}).run()["y"].gum.estimate  # error
round(gu.from_dict({}, conditions={}).run()["y"].gum.estimate, 3)  # error
