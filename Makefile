# Whine: one graph from a scene to the figures. `make` prints the targets; pipelines/*.mk hold the stages.
#
#   programs   tools/gear-x.cpp and what it includes of common/ -> build/bin/gear-x   (this file, pipelines/sources.awk)
#   names      what a user's paths may hold                                  (pipelines/names.mk)
#   scenes     which scene files the goals need, and what they say to make       (pipelines/scenes.mk)
#   studies    variants of a scene -> a table of their response quantities       (pipelines/studies.mk)
#   compare    scenes side by side -> out/compare                         (pipelines/compare.mk)
#   stages     scene -> mesh -> body -> static -> sweep -> response              (pipelines/stages.mk)
#   figures    artifacts -> out/figures, out/<scene>/report                      (pipelines/figures.mk)
#
# Results depend on the contents of the programs and of the scenes, never on their time stamps alone.

# Before any shell runs: what the user has named is looked at there.
include pipelines/names.mk

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

goals := $(or $(MAKECMDGOALS),help)
# a literal comma for $(if)
, := ,
$(if $(filter clean%,$(goals)),$(if $(filter-out clean%,$(goals)),\
  $(error $(filter clean%,$(goals)) goes alone: first `make $(filter clean%,$(goals))`, then `make $(filter-out clean%,$(goals))`)))

# A goal that is neither a path nor a target: the targets that are spelt alike.
documented := $(shell sed -n 's/^\([a-z0-9-]*\):.*\#\# .*/\1/p' Makefile pipelines/*.mk)
near = $(firstword $(shell printf '%s\n' $2 | awk -v word='$(subst ','\'',$1)' -f pipelines/nearest.awk))
meant = $(foreach n,$(call near,$1,$2), did you mean $n?)
no_such_target = $(error $1: $(if $(filter %.toml,$1),a scene is given by SCENE in front of a target: make SCENE=$1 report,$(strip \
  there is no such target;$(call meant,$1,$(documented)) `make help` lists them)))
$(foreach g,$(filter-out $(documented) FORCE fig%,$(goals)),$(if $(or $(findstring /,$g),$(filter-out %.toml,$(wildcard $g))),,$(call no_such_target,$g)))

# A variable that nothing reads is a slip of the pen, which would otherwise be ignored without a word.
variables_read := $(names_given) LAUNCH B CXX ARCH OPTIMISE CXXFLAGS CPPFLAGS LDFLAGS LDLIBS COLD_FLAGS STEP_FLAGS
$(foreach v,$(filter-out $(variables_read) LAUNCH_% SHELL MAKE%,$(.VARIABLES)),$(if $(findstring command line,$(origin $v)),\
  $(error $v: there is no such variable;$(call meant,$v,$(variables_read)) pipelines/README.md lists them)))

# --- programs -------------------------------------------------------------------------------------------------

# Sanitized objects do not fit others.
SANITIZE := $(or $(SANITIZE),$(filter test-sanitize,$(goals)))
B := build$(if $(SANITIZE),/sanitize)
CXX := g++
# Half the time of a sweep is dense algebra: AVX2 and FMA where the processor has them. Bytes are the same on one type of
# machine; ARCH= builds for any. Moves of 256 bits (g++ 12 on) clear and copy small arrays without a string instruction, which is slow to start.
processor := $(if $(wildcard /proc/cpuinfo),$(file < /proc/cpuinfo))
ARCH := $(if $(and $(filter avx2,$(processor)),$(filter fma,$(processor))),-march=x86-64-v3 -mmove-max=256 -mstore-max=256)
OPTIMISE := -O2 $(ARCH)
# Without NDEBUG an assert would put its line number into the program, and a comment would redo results.
# Hidden: gmsh carries an Eigen without AVX, which would take over exported templates of ours and free what it did not allocate.
# g++ 12 sees AVX loads beyond the end of Eigen's small vectors that it has itself proved not to happen.
# Sanitizers: a null pointer and what lies outside its object end in a report of ASan, a vector that is not aligned in a fault: without
# UBSan's own checks of them, one at each access to memory, a file is compiled in 0.7 of the time.
# Sections: a program holds the functions that it uses, not all of the units that they are in, so that a change in a unit of which it uses
# none leaves its bytes.
CXXFLAGS := -std=c++20 -fvisibility=hidden -ffunction-sections -fdata-sections -Wall -Wextra -Wno-array-bounds $(if $(SANITIZE),-O1 -g1 $(ARCH) -D_GLIBCXX_ASSERTIONS \
  -fsanitize=address$(,)undefined -fno-sanitize-recover=undefined -fno-sanitize=null$(,)alignment$(,)object-size,\
  $(OPTIMISE) -DNDEBUG)
# A step runs through loops over two to five lanes, which -O3 unrolls: with it, and without a precompiled header that was made
# without, steps of lines take 8 % less.
STEP_FLAGS := $(if $(SANITIZE),,-O3)
# Layers that read, write, draw and print, the programs' own sources and tests, whose numbers come out of the other layers: compiled in
# half the time, with sanitizers in 0.4 of it.
COLD_FLAGS := $(if $(SANITIZE),-O0,-Og)
cold_layers := report paper io
CPPFLAGS := -Icommon -isystem /usr/include/eigen3 -isystem /usr/include/suitesparse
# gold, where binutils has it, links a program in a fifth of the time of the other linker.
gold := $(if $(wildcard /usr/bin/ld.gold),-fuse-ld=gold)
LDFLAGS := $(if $(SANITIZE),-fsanitize=address$(,)undefined) $(gold) -Wl,--as-needed -Wl,--gc-sections
# Recursive: pkg-config may itself be one of the packages that `deps` installs in the same run.
HDF5_CFLAGS = $(shell pkg-config --cflags hdf5)
LDLIBS = -lpugixml -lz -lzip -ljsoncpp -lsndfile -lcholmod $(shell pkg-config --libs-only-L hdf5) -lhdf5_hl $(shell pkg-config --libs hdf5 fftw3 libcrypto)

# Libraries that bring many more: gmsh a hundred of windows, pictures and CAD, whose loading takes 0.25 s of CPU at each start, the others
# together 18 of 43 ms. Programs that do not call one do without; the linker says where one is missing from this list; of functions that
# it throws away it asks nothing. Sanitizers keep them.
users_of_-lgmsh := gear-mesh gear-reduce gear-static gear-sweep gear-reading
users_of_-lcholmod := gear-reduce gear-loaded gear-animate gear-static gear-sweep gear-reading
users_of_-lsndfile := gear-sound
users_of_-lzip := gear-import gear-export whine-replay-rexs
users_of_-lpugixml := gear-import gear-export whine-replay-rexs
not_used = $(foreach l,-lgmsh -lcholmod -lsndfile -lzip -lpugixml,$(if $(filter $(@F),$(users_of_$l)),,$l))
libraries = $(filter-out $(if $(SANITIZE)$(filter-out gear-% whine-replay-%,$(@F)),,$(not_used)),-lgmsh $(LDLIBS))

# With `deps` among the goals whatever uses a package waits for it, in any order of the goals and under -j.
with_deps := $(filter deps,$(goals))

# Sources are compiled in units, a layer or a part of one at a time: alone, each reads and instantiates the same headers again, which
# took half of a build. Apart from the rest of their layer: what has flags of its own, and parts of the long layers.
unit_expressions := base/dense=base/dense.* base/eigen_templates=base/eigen_templates base/options=base/options \
  dynamics/step_kernel=dynamics/step_kernel dynamics/step_kernel_pack=dynamics/step_kernel_pack dynamics/system=dynamics/system_.* \
  io/codecs=io/.*_codec io/scenes=io/(rexs|scene|section|stage|study|system|toml|variant).* \
  report/system=report/(system|teeth|root|flank|runup|order|sound|wire).* report/report=report/(report|html|compare|exported).*
# A program waits for the units behind the headers that it includes, and for no other.
links := $(shell awk -v units='$(unit_expressions)' -f pipelines/sources.awk $(wildcard common/*/*.h common/*/*.cpp common/*/*/*.h common/*/*/*.cpp tools/*.cpp tests/fuzz/*.cpp))
# Sorted, here and below: the order of `wildcard` follows the locale, and another order would compile everything anew.
sources_of = $(sort $(patsubst $1=%,common/%.cpp,$(filter $1=%,$(links))))
units := $(sort $(foreach l,$(links),$(if $(findstring =,$l),$(firstword $(subst =, ,$l)))))
cold_units := $(filter $(cold_layers:%=%/%),$(units))
# The cold ones last: a linker takes an inline function from the first object that has it.
library := $(patsubst %,$(B)/obj/common/%.o,$(filter-out $(cold_units),$(units)) $(cold_units))
tools := $(sort $(patsubst tools/%.cpp,%,$(wildcard tools/gear-*.cpp)))
tool_objects := $(tools:%=$(B)/obj/tools/%.o)
hard_cases := $(B)/obj/tests/hard_cases.o
# Tests go together by the first letters of their names, the rest of them in one unit more.
test_letters := [a-d] e,f[a-q] f[r-z],[g-i] [j-o] [p-r] s[a-x]
test_numbers := 1 2 3 4 5 6
tests_by_letters = $(sort $(wildcard $(patsubst %,tests/test_%*.cpp,$(subst $(,), ,$(word $1,$(test_letters))))))
tests_of = $(if $(filter rest,$1),$(filter-out $(foreach n,$(test_numbers),$(call tests_by_letters,$n)),$(sort $(wildcard tests/test_*.cpp))),$(call tests_by_letters,$1))
# Sanitizers look for errors in what is tested and in what tests have inline of it (library objects are linked first): tests are those
# of the other build, which spares a quarter of the time of compiling.
test_units := $(patsubst %,build/obj/tests/unit_%.o,$(test_numbers) rest)
own_test_units := $(if $(SANITIZE),,$(test_units))
objects := $(library) $(tool_objects) $(B)/obj/tests/main.o $(own_test_units) $(hard_cases)

.PHONY: build
build: $(tools:%=$(B)/bin/%) ## compile the programs into build/bin

folders := $(sort $(B)/obj/ $(dir $(objects)) $(B)/bin/ $(B)/id/ $(B)/scenes/)
$(folders):
	@mkdir -p $@
.SECONDEXPANSION: # $$(@D)/ below

# Half of a compilation is reading the headers in it. Compiled headers fit one set of flags.
precompiled := $(B)/obj/precompiled.h
cold_precompiled := $(B)/obj/$(if $(COLD_FLAGS),cold,precompiled).h
$(addsuffix .gch,$(sort $(precompiled) $(cold_precompiled))): common/base/precompiled.h common/base/eigen_templates.h common/base/dense_products.h $(B)/flags | $$(@D)/ $(with_deps)
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -x c++-header -o $@ $<

cold_objects := $(tool_objects) $(B)/obj/tests/main.o $(own_test_units) $(hard_cases) $(B)/obj/common/base/options.o $(filter $(foreach r,$(cold_layers),$(B)/obj/common/$r/%),$(library))
INCLUDE_PRECOMPILED = -include $(precompiled)
$(cold_objects): private INCLUDE_PRECOMPILED = -include $(cold_precompiled)
$(cold_objects) $(cold_precompiled).gch: private CXXFLAGS += $(COLD_FLAGS)
$(cold_objects): $(cold_precompiled).gch
$(filter-out $(cold_objects),$(objects)): $(precompiled).gch
compile = $(CXX) $(CPPFLAGS) $(CXXFLAGS) $(INCLUDE_PRECOMPILED) -MMD -MP -MF $(@:.o=.d) -MT $@ -c -o $@
$(filter-out $(library) $(own_test_units),$(objects)): $(B)/obj/%.o: %.cpp $(B)/flags | $$(@D)/ $(with_deps)
	$(compile) $<
$(library): $(B)/obj/common/%.o: $$(call sources_of,$$*) $(B)/flags $$(@:.o=.unit) | $$(@D)/ $(with_deps)
	printf '#include "%s"\n' $(filter %.cpp,$^) | $(compile) -x c++ -
$(own_test_units): $(B)/obj/tests/unit_%.o: $$(call tests_of,$$*) pipelines/test_unit.awk $(B)/flags $$(@:.o=.unit) | $$(@D)/ $(with_deps)
	awk -f pipelines/test_unit.awk $(filter %.cpp,$^) | $(compile) -Itests -x c++ -
$(if $(SANITIZE),$(test_units)) &: FORCE | $(with_deps)
	+@$(MAKE) --no-print-directory SANITIZE= B=build $(test_units)

# Assertions as calls rather than as code in place: a third of the time of compiling them. Private: the precompiled header, of
# which a test may be the first that wants it, is not of the tests.
$(filter $(B)/obj/tests/%,$(objects)): private CPPFLAGS += -DDOCTEST_CONFIG_SUPER_FAST_ASSERTS

# Nothing of ours but calls of Eigen's decompositions and of the library of options.
$(filter $(B)/obj/common/base/dense.o $(B)/obj/common/base/eigen_templates.o $(B)/obj/common/base/options.o,$(objects)): private CXXFLAGS += $(if $(SANITIZE),-fno-sanitize=undefined)

step_objects := $(B)/obj/common/dynamics/step_kernel.o $(B)/obj/common/dynamics/step_kernel_pack.o $(filter $(B)/obj/common/contact/%,$(objects))
$(step_objects): private CXXFLAGS += $(STEP_FLAGS)
# Nor with the one that says that its templates are compiled elsewhere; products of matrices are the same everywhere.
$(step_objects): private INCLUDE_PRECOMPILED := -include base/dense_products.h
$(B)/obj/common/base/eigen_templates.o: private INCLUDE_PRECOMPILED :=

# HDF5 stays in one layer: nobody else finds its headers.
$(filter $(B)/obj/common/io/%,$(objects)): private CPPFLAGS += $(HDF5_CFLAGS)

linked = $(filter $(patsubst $1:%,$(B)/obj/common/%.o,$(filter $1:%,$(links))),$(library))
link = $(CXX) $(LDFLAGS) -o $@ $(filter %.o,$^) $(libraries)

$(tools:%=$(B)/bin/%): $(B)/bin/%: $$(call linked,$$*) $(B)/obj/tools/%.o | $(B)/bin/
	$(link)

# The folder stands for its list of files: a test that goes away leaves the program, too.
$(B)/bin/whine-tests: $(library) $(B)/obj/tests/main.o $(test_units) tests | $(B)/bin/
	$(link)

$(B)/bin/whine-hard-cases: $(library) $(hard_cases) | $(B)/bin/
	$(link)

flags := $(CXX) $(CPPFLAGS) $(CXXFLAGS) $(COLD_FLAGS) $(STEP_FLAGS) $(LDFLAGS)
# Equal as whole texts: objects of different flags do not fit each other (Eigen's alignment follows the processor). $(strip): make 4.3
# leaves the newline of $(file <...) where its buffer has moved.
said_before = $(strip $(file <$1))
differs = $(if $(and $(findstring x$(strip $2)x,x$(call said_before,$1)x),$(findstring x$(call said_before,$1)x,x$(strip $2)x)),,FORCE)
$(B)/flags: $(call differs,$(B)/flags,$(flags))
$(B)/flags:
	@mkdir -p $(@D)
	@echo '$(flags)' > $@

# The list of sources of a unit: one that is added may be older than it.
define unit_list
$1: $(call differs,$1,$2)
$1: private sources := $2
endef
$(foreach o,$(library),$(eval $(call unit_list,$(o:.o=.unit),$(call sources_of,$(patsubst $(B)/obj/common/%.o,%,$o)))))
$(foreach o,$(own_test_units),$(eval $(call unit_list,$(o:.o=.unit),$(call tests_of,$(patsubst $(B)/obj/tests/unit_%.o,%,$o)))))
$(patsubst %.o,%.unit,$(library) $(own_test_units)):
	@mkdir -p $(@D)
	@echo '$(sources)' > $@

-include $(objects:.o=.d)

# Tool ids: what results depend on instead of the programs. The hash of a program replaces its file only if it
# differs, so that a program that was linked anew with the same bytes redoes nothing. `+`: also under make -n,
# which would otherwise take every result for stale.
id = $(if $(FREEZE),,$(B)/id/$1)
# Machine and number of the shell in the name: two makes on one tree do not write the same file.
new = $1.new.$$HOSTNAME.$$$$

$(tools:%=$(B)/id/%): $(B)/id/%: $(B)/bin/% | $(B)/id/
	+@[ ! -e $< ] || { said=$$(sha256sum < $<); [ -e $@ ] && [ "$$said" = "$$(< $@)" ] || { [ -d $(@D) ] || mkdir -p $(@D); echo "$$said" > $(call new,$@); mv $(call new,$@) $@; }; }

include pipelines/figures.mk pipelines/scenes.mk pipelines/studies.mk pipelines/bifurcations.mk pipelines/stages.mk pipelines/systems.mk pipelines/compare.mk pipelines/maps.mk pipelines/bench.mk pipelines/robust.mk pipelines/reading.mk

# Figures of P2000 that are none of ours, and what is of its scenes only.
$(foreach f,$(filter-out figures $(figures),$(filter fig%,$(goals))),\
  $(error $f: there is no such figure; there are $(figures) and table1 (Figures 2, 4 and 6 of P2000 are a sketch and measurements)))
$(if $(SCENE),$(if $(filter scorecard out/figures/scorecard%,$(goals)),\
  $(error scorecard: it is what P2000 prints beside its own scenes, $(paper_scenes); leave SCENE out)))

# --- packages -------------------------------------------------------------------------------------------------

packages := g++ pkgconf libgmsh-dev libsuitesparse-dev libeigen3-dev libhdf5-dev libfftw3-dev \
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

test test-slow test-all: build $(B)/bin/whine-tests $(tools:%=$(B)/id/%) | $(with_deps)
	@B=$(B) TESTS=$(patsubst test-%,%,$@) tests/run
test test-all: $(replays)
test-slow test-all: $(B)/bin/whine-hard-cases
test: ## run the tests but for the slow ones; the last line is `N passed, N failed`
test-slow: ## run those that tests/slow lists
test-all: ## run both, and the few cases that take half a minute each

format: ## lay out the C++ sources with clang-format
	clang-format -i $(wildcard common/*/*.h common/*/*.cpp common/*/*/*.h common/*/*/*.cpp tools/*.cpp tests/*.h tests/*.cpp tests/*/*.h tests/*/*.cpp)

check-format: ## fail if clang-format would change a source
	clang-format --dry-run -Werror $(wildcard common/*/*.h common/*/*.cpp common/*/*/*.h common/*/*/*.cpp tools/*.cpp tests/*.h tests/*.cpp tests/*/*.h tests/*/*.cpp)

.PHONY: help clean clean-figures clean-studies clean-motion clean-out
help: ## print this list (its order: pipelines/help.txt)
	@echo 'Whine: gear whine from elastic teeth that touch, part and touch again. Targets by task:'
	@awk -f pipelines/help.awk pipelines/help.txt Makefile pipelines/*.mk
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
