# Whine: one graph from a scene to the figures. `make` prints the targets; pipelines/*.mk hold the stages.
#
#   programs   tools/gear-x.cpp and what it includes of common/ -> build/bin/gear-x   (tools/CMakeLists.txt, called by this file)
#   scenes     which scene files the goals need, and what they tell make         (pipelines/scenes.mk)
#   studies    variants of a scene -> a table of their response quantities       (pipelines/studies.mk)
#   compare    scenes side by side -> out/compare                         (pipelines/compare.mk)
#   stages     scene -> mesh -> body -> static -> sweep -> response              (pipelines/stages.mk)
#   figures    artifacts -> out/figures, out/<scene>/report                      (pipelines/figures.mk)
#
# Results depend on the contents of the programs and of the scenes, never on their time stamps alone.

goals := $(or $(MAKECMDGOALS),help)
B := build$(if $(or $(value SANITIZE),$(filter test-sanitize,$(goals))),/sanitize)

# Goals and variables of a user: make reads `$` and `%` in them, and a shell all that it does not take for a letter. So gear-scene judges them
# first (common/io/make_request.cpp); it is given their text by $(value), which does not expand, in quotes, which no shell looks into.
# A line break, which make would drop, is given as \n.
define line_break


endef
quoted = '$(subst $(line_break),\n,$(subst ','\'',$1))'
command_line := $(foreach v,$(.VARIABLES),$(if $(findstring command line,$(origin $v)),$v))
given := $(foreach v,$(command_line), --given $(call quoted,$v=$(value $v)))
judge := $(firstword $(wildcard $(B)/bin/gear-scene build/bin/gear-scene))
wrong := $(if $(judge),$(shell $(judge) --goals $(call quoted,$(goals)) $(given) 2> /dev/null))
judged := $(if $(judge),$(if $(wrong),,$(filter 0,$(.SHELLSTATUS))))
# One that is older than its sources may not know a new target: then it is compiled first, as where there is none.
$(if $(wrong),$(if $(shell find common tools/gear-scene.cpp -name '*.[hc]*' -newer $(judge) -print -quit),,$(error $(wrong))))

# Make expands variables of the command line for the environment of every command.
$(if $(judged),,$(foreach v,$(filter-out LAUNCH% CXX% LDFLAGS ARCH,$(command_line)),$(if $(findstring $$,$(value $v)),$(error $v: it holds $$, which make would expand; rename what it names))))

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
# As many jobs as processors unless -j says otherwise; no built-in rules.
processors := $(shell nproc 2>/dev/null || echo 1)
MAKEFLAGS += -rR -j$(processors)
.DELETE_ON_ERROR:
# $(call together,files): those that a program publishes together, each whole or as it was. Make has not looked at the times of all of
# them before the recipe, and would take those for half made if it fails.
together = $(eval .PRECIOUS: $1)$1
.DEFAULT_GOAL := help
.PHONY: FORCE
FORCE:

# Every stage is parallel by being many; a BLAS with threads of its own would only take them from each other,
# and would sum in an order that depends on their number.
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1

# a literal comma for $(if)
, := ,
$(if $(filter clean%,$(goals)),$(if $(filter-out clean%,$(goals)),\
  $(error $(filter clean%,$(goals)) goes alone: first `make $(filter clean%,$(goals))`, then `make $(filter-out clean%,$(goals))`)))

# --- programs -------------------------------------------------------------------------------------------------

# tools/CMakeLists.txt says how they are compiled. Make asks for a program that is older than a source; ninja knows what of it is.
# Sanitized objects do not fit others.
sanitized := $(filter %/sanitize,$(B))
CXX := g++
CXXFLAGS :=
LDFLAGS :=
# Half the time of a sweep is dense algebra: AVX2 and FMA where the processor has them. Bytes are the same on one type of
# machine; ARCH= builds for any. Moves of 256 bits (g++ 12 on) clear and copy small arrays without a string instruction, which is slow to start.
processor := $(if $(wildcard /proc/cpuinfo),$(file < /proc/cpuinfo))
ARCH := $(if $(and $(filter avx2,$(processor)),$(filter fma,$(processor))),-march=x86-64-v3 -mmove-max=256 -mstore-max=256)

# With `deps` among the goals whatever uses a package waits for it, in any order of the goals and under -j.
with_deps := $(filter deps,$(goals))
with_deps_bench := $(with_deps) $(filter deps-bench,$(goals))

# Sorted: the order of `wildcard` follows the locale.
below = $(sort $(wildcard $(foreach d,$1/* $1/*/* $1/*/*/*,$d.h $d.cpp)))
library_sources := $(call below,common) tools/CMakeLists.txt
test_sources := $(call below,tests)
siconos := $(wildcard /usr/include/siconos/numerics/lcp_cst.h)
tools := $(sort $(patsubst tools/%.cpp,%,$(wildcard tools/gear-*.cpp)))
programs := $(tools:%=$(B)/bin/%)
fuzz_targets := scene study rexs transfer artifact sealed
replays := $(fuzz_targets:%=$(B)/bin/whine-replay-%)
test_programs := $(addprefix $(B)/bin/,whine-tests whine-hard-cases $(if $(siconos),whine-siconos)) $(replays)
bench_programs := $(addprefix $(B)/bin/,whine-bench whine-bench-stress whine-bench-width whine-bench-levels whine-bench-train whine-work-precision whine-verify-accuracy whine-stress-contact)
test_cases := build/lib/libtest_cases.a

$(programs): $(B)/bin/%: tools/%.cpp
$(test_programs) $(bench_programs) $(test_cases): $(test_sources)
$(programs) $(test_programs) $(bench_programs) $(test_cases): $(library_sources) $(B)/settings | $(with_deps_bench)

# What all programs are compiled by. A source that is added may be older than they are. Equal as whole texts; $(strip): make 4.3 leaves the
# newline of $(file <...) where its buffer has moved.
settings := $(CXX) $(CXXFLAGS) $(LDFLAGS) $(ARCH) $(siconos) $(wildcard /usr/bin/ld.lld) $(library_sources) $(test_sources)
said_before = $(strip $(file <$1))
differs = $(if $(and $(findstring x$(strip $2)x,x$(call said_before,$1)x),$(findstring x$(call said_before,$1)x,x$(strip $2)x)),,FORCE)
$(B)/settings: export text = $(settings)
$(B)/settings: $(call differs,$(B)/settings,$(settings))
	@mkdir -p $(@D)
	@echo "$$text" > $@

# $(call configure,folder,options), $(call ninja,folder,files); $(call compile,files): one ninja at a time, with as many jobs as make.
configure = cmake -S tools -B $1 -G Ninja -DCMAKE_CXX_COMPILER='$(CXX)' -DCMAKE_CXX_FLAGS='$(CXXFLAGS)' -DCMAKE_EXE_LINKER_FLAGS='$(LDFLAGS)' -DARCH='$(ARCH)' $2 > $1/configured
ninja = ninja -C $1 $(filter-out -j,$(filter -j%,$(MAKEFLAGS))) $(patsubst $1/%,%,$2)
define compile
	@exec 9> $(B)/lock; flock 9; \
	[ $(B)/build.ninja -nt $(B)/settings ] $(if $(filter deps-bench,$(goals)),&& false) || $(call configure,$(B),-DSANITIZE=$(if $(sanitized),ON,OFF)); \
	$(call ninja,$(B),$1); touch $1
endef
# Who wants many of them asks once.
every := $(if $(filter build test test-slow test-all test-faults test-report,$(goals)),$(programs)) $(if $(filter test test-slow test-all,$(goals)),$(test_programs))
ifneq ($(strip $(every)),)
$(call together,$(every)) &:
	$(call compile,$(every))
endif
$(filter-out $(every),$(programs) $(test_programs) $(bench_programs)) $(if $(sanitized),,$(test_cases)):
	$(call compile,$@)
# The cases under sanitizers are the objects of the other build.
ifneq ($(sanitized),)
$(B)/bin/whine-tests: $(test_cases)
$(test_cases): FORCE
	+@$(MAKE) --no-print-directory SANITIZE= B=build $@
endif

.PHONY: build
build: $(programs) ## compile the programs into build/bin

$(B)/id/ $(B)/scenes/:
	@mkdir -p $@
.SECONDEXPANSION: # $$(@D)/ in pipelines/

# Tool ids: what results depend on instead of the programs. The hash of a program replaces its file only if it
# differs, so that a program that was linked anew with the same bytes redoes nothing. `+`: also under make -n,
# which would otherwise take every result for stale.
id = $(if $(FREEZE),,$(B)/id/$1)
# Machine and number of the shell in the name: two makes on one tree do not write the same file.
new = $1.new.$$HOSTNAME.$$$$

$(tools:%=$(B)/id/%): $(B)/id/%: $(B)/bin/% | $(B)/id/
	+@[ ! -e $< ] || { said=$$(sha256sum < $<); [ -e $@ ] && [ "$$said" = "$$(< $@)" ] || { [ -d $(@D) ] || mkdir -p $(@D); echo "$$said" > $(call new,$@); mv $(call new,$@) $@; }; }

# What reads no scene needs no gear-scene either. For the rest it is compiled if it is not there, or does not know these options; then make
# starts again.
include tests/checks.mk
reads_scenes := $(filter-out help build test test-slow test-all test-sanitize test-report test-slurm hard-cases format check-format lint replay deps deps-% clean clean-% FORCE $(B)/%,$(goals))
ifneq ($(and $(reads_scenes),$(judged)),)
include $(addprefix pipelines/,figures.mk scenes.mk studies.mk bifurcations.mk stages.mk compare.mk maps.mk bench.mk reading.mk)
else ifneq ($(reads_scenes),)
targets := $(shell awk -f pipelines/help.awk pipelines/help.txt Makefile pipelines/*.mk tests/*.mk | sed -n 's/^  \([a-z0-9-]*\) .*/\1/p')
$(foreach g,$(filter-out $(targets),$(reads_scenes)),$(if $(findstring /,$g),,$(error $g: there is no such target; `make help` lists them)))
$(if $(MAKE_RESTARTS),$(error $(or $(wrong),$(judge) --goals cannot judge what make is given; make clean$(,) then start again)))
include $(B)/judged.mk
$(B)/judged.mk: $(B)/bin/gear-scene FORCE
	@touch $@
endif

# --- packages -------------------------------------------------------------------------------------------------

packages := g++ cmake ninja-build lld pkgconf libgmsh-dev libsuitesparse-dev libeigen3-dev libhdf5-dev libfftw3-dev \
  libtomlplusplus-dev libpugixml-dev libzip-dev zlib1g-dev libjsoncpp-dev libsndfile1-dev libcli11-dev libssl-dev doctest-dev libopenblas0-pthread hdf5-tools gnuplot-nox fonts-dejavu-core
dry_run := $(findstring n,$(filter-out -%,$(firstword $(MAKEFLAGS))))

define install_wanted
	@missing=; for package in $(wanted); do \
	  case "$$(dpkg-query -W -f '$${Status}' $$package 2>/dev/null)" in \
	    "install ok installed") ;; *) missing="$$missing $$package" ;; esac; done; \
	if [ -z "$$missing" ]; then \
	  [ -n "$(MAKE_RESTARTS)" ] || echo "$@: all $(words $(wanted)) packages are installed"; exit 0; fi; \
	if [ -n "$(dry_run)" ]; then echo "$@: make -n installs nothing; missing:$$missing" >&2; exit 1; fi; \
	sudo=; if [ "$$(id -u)" != 0 ]; then sudo=sudo; command -v sudo > /dev/null || { \
	  echo "$@: not root and no sudo; as root run: apt-get install$$missing" >&2; exit 1; }; fi; \
	echo "$@: installing$$missing"; \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get update -q; \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $$missing
endef

.PHONY: deps
deps: wanted := $(packages)
deps: ## install the Debian packages that `figures` and `test` need
	$(install_wanted)

.PHONY: deps-vtk
deps-vtk: wanted := python3-vtk9
deps-vtk: | $(with_deps) ## install VTK for the one check in `test` that reads artifacts as ParaView does
	$(install_wanted)

.PHONY: deps-python
deps-python: wanted := python3-xarray python3-h5netcdf python3-matplotlib
deps-python: | $(with_deps) ## install xarray and matplotlib for the checks in `test` that open artifacts by their axes and run data/examples
	$(install_wanted)

# --- tests and upkeep -----------------------------------------------------------------------------------------

.PHONY: hard-cases test test-slow test-all format check-format
hard-cases: $(B)/bin/whine-hard-cases | $(with_deps) ## hard cases with known answers: expected, found, allowed; status 1 if one fails
	@$<

test test-slow test-all: build $(tools:%=$(B)/id/%) | $(with_deps)
	@B=$(B) TESTS=$(patsubst test-%,%,$@) tests/run
test test-slow test-all: $(test_programs)
test: ## run the tests but for the slow ones; the last line is `N passed, N failed`
test-slow: ## run those that tests/slow lists
test-all: ## run both, and the few cases that take half a minute each

format: ## lay out the C++ sources with clang-format
	clang-format -i $(filter-out %.txt,$(library_sources)) $(test_sources) $(tools:%=tools/%.cpp)

check-format: ## fail if clang-format would change a source
	clang-format --dry-run -Werror $(filter-out %.txt,$(library_sources)) $(test_sources) $(tools:%=tools/%.cpp)

.PHONY: help clean clean-figures clean-studies clean-motion clean-out
help: ## print this list (its order: pipelines/help.txt)
	@echo 'Whine: gear whine from elastic teeth that touch, part and touch again. Targets by task:'
	@awk -f pipelines/help.awk pipelines/help.txt Makefile pipelines/*.mk tests/*.mk
	@echo 'Any artifact is a target, at any torque in N m; the scene stands in its path:'
	@echo '  make out/parker2000/T600/up/response.h5'
	@echo '  make SCENE=path/to/scene.toml sweep'
	@echo '  make -j64 figures LAUNCH="srun -n1 --exact"     on a cluster; LAUNCH_sweep=... for one kind of stage'
	@echo 'FREEZE=1 keeps results although their program changed; SANITIZE=1 compiles with sanitizers into build/sanitize.'

clean: ## remove build/ (programs; results stay valid)
	rm -rf build

clean-figures: ## remove the figures (seconds to make again)
	rm -rf out/figures out/*/report

clean-studies: ## remove what studies have computed; bodies stay
	rm -rf out/studies

clean-motion: ## remove statics, sweeps and responses of all scenes (minutes); bodies stay
	rm -rf out/*/T[0-9]*

clean-out: ## remove out/ with the cached meshes and bodies
	rm -rf out
