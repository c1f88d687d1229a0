# What machine and input may do to a result: sanitizers, faults, fuzzing, numbers under stress, static checks.
#
#   make test-sanitize        the tests of the programs' parts under ASan, UBSan and -D_GLIBCXX_ASSERTIONS, without the slow ones
#   make test-faults          kills, full disks, damaged files, two makes at once; FAULT_KILLS=50
#   make fuzz                 FUZZ_SECONDS=60 for each reader, from the corpus in tests/fuzz/corpus
#   make stress               contact problems and whole scenes by the thousand; STRESS_PROBLEMS, STRESS_SCENES
#   make test-report          reports of whole scenes, their pages in a headless browser
#   make lint                 clang-tidy of common/ and tools/, include direction of the layers, sizes of files and functions, shellcheck

.PHONY: deps-lint deps-fuzz
deps-lint: wanted := clang-tidy clang-format shellcheck
deps-lint: | $(with_deps) ## install the packages that only `lint` uses
	$(install_wanted)
deps-fuzz: wanted := clang libclang-rt-14-dev
deps-fuzz: | $(with_deps) ## install the packages that only `fuzz` uses
	$(install_wanted)

# --- sanitizers

.PHONY: test-sanitize
test-sanitize: $(B)/bin/whine-tests | $(with_deps) ## the tests under ASan, UBSan and -D_GLIBCXX_ASSERTIONS, but for the slow cases in tests/slow and tests/unsanitized
	@B=$(B) TESTS=sanitize LSAN_OPTIONS=suppressions=tests/leaks:print_suppressions=0 tests/run

# --- faults

FAULT_KILLS ?= 50
.PHONY: test-faults
test-faults: build $(tools:%=$(B)/id/%) | $(with_deps) ## kills, full disks, damaged files, clocks set back, two makes: each ends in the same bytes or says why; FAULT_KILLS=50
	@B=$(B) FAULTS=all FAULT_KILLS=$(FAULT_KILLS) MAKEFLAGS= MAKELEVEL= bash tests/faults.sh | tee $(B)/faults.log; ! grep -q '^FAILED' $(B)/faults.log

# --- reports

.PHONY: deps-browser test-report
deps-browser: wanted := chromium
deps-browser: | $(with_deps) ## install the browser that only `test-report` uses
	$(install_wanted)
test-report: build $(tools:%=$(B)/id/%) | $(with_deps) $(filter deps-browser,$(goals)) ## reports of FZG and NASA gears at coarse settings: known numbers, figures, pages in a headless browser
	@B=$(B) MAKEFLAGS= MAKELEVEL= bash tests/report.sh | tee $(B)/report.log; ! grep -q '^FAILED' $(B)/report.log

# --- numbers under stress

STRESS_PROBLEMS ?= 1000000
STRESS_SCENES ?= 200
STRESS_SEED ?= 1
$(B)/bin/whine-stress-contact: tests/stress/contact.cpp tests/paper_pair.h tests/peer/strip_problems.h tests/peer/window_problem.h $(B)/flags $(library) | $(B)/bin/ $(with_deps)
	$(CXX) $(CPPFLAGS) -Itests $(CXXFLAGS) $(LDFLAGS) -o $@ $< $(library) -lgmsh $(LDLIBS)

.PHONY: stress
stress: $(B)/bin/whine-stress-contact build ## a million contact problems and 200 random scenes: a certificate, a closed energy balance or an error that says why; STRESS_PROBLEMS, STRESS_SCENES
	@$< $(STRESS_PROBLEMS) $(STRESS_SEED)
	@B=$(B) tests/stress/scenes.sh $(STRESS_SCENES) $(STRESS_SEED)

# --- static checks

lint_scripts := $(wildcard tests/*.sh tests/*/*.sh pipelines/*.sh) tests/run .ci/run
# The units of compilation, and the programs as two more.
lint_program_units := tools/a-l tools/m-z
lint_sources_of = $(if $(filter tools/%,$1),$(sort $(wildcard tools/gear-[$(notdir $1)]*.cpp)),$(call sources_of,$1))
lint_checked := $(patsubst %,$(B)/lint/%,$(units) $(lint_program_units))
# __builtin_shuffle is g++'s alone. The analyzer gives up a function after 50000 states instead of 225000: what it spends beyond
# goes into Eigen's loops and takes as long as all other checks. A unit that passed is checked again when a source of it, a header that
# it sees or the list of checks has changed.
with_deps_lint := $(with_deps) $(filter deps-lint,$(goals))
$(lint_checked): $(B)/lint/%: $$(call lint_sources_of,$$*) .clang-tidy pipelines/lint_unit.awk | $(with_deps_lint)
	@mkdir -p $(@D)
	@awk -f pipelines/lint_unit.awk $(filter %.cpp,$^) > $@.cpp
	@$(CXX) $(CPPFLAGS) $(HDF5_CFLAGS) -std=c++20 -MM -MP -MT $@ -MF $@.d $@.cpp
	@clang-tidy --quiet --config-file=.clang-tidy $@.cpp -- -std=c++20 $(CPPFLAGS) $(HDF5_CFLAGS) '-D__builtin_shuffle(a,b,order)=((a)+(b))' -Xclang -analyzer-config -Xclang max-nodes=50000 2> /dev/null > $@.new || \
	  { awk -v unit=$@.cpp -f pipelines/lint_unit.awk $@.cpp $@.new >&2; exit 1; }
	@mv $@.new $@
-include $(lint_checked:=.d)

.PHONY: lint
check-format: | $(with_deps_lint)
lint: $(lint_checked) check-format ## clang-tidy (.clang-tidy says which checks and why), include direction of the layers, sizes of files and functions, shellcheck
	@shellcheck $(lint_scripts)
	@for test in layers sizes; do B=$(B) bash tests/$$test.sh | tee $(B)/lint/$$test; done; ! grep -q '^FAILED' $(B)/lint/layers $(B)/lint/sizes

# --- fuzzing

FUZZ_SECONDS ?= 60
fuzz_targets := scene study rexs transfer artifact sealed
# Dense decompositions take clang minutes and a gigabyte, and no reader uses one; what expands a study, fits a lumped model or sets inertias as drawn calls physics.
fuzz_sources := $(filter-out common/base/dense% common/io/study_expansion.cpp common/io/lumped_inputs.cpp common/io/pair_inputs.cpp common/io/scene_remarks.cpp,$(wildcard common/base/*.cpp common/model/*.cpp common/io/*.cpp common/io/rexs/*.cpp))
fuzz_flags := -std=c++20 -g -O1 -fno-omit-frame-pointer -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined

$(B)/fuzz/ $(B)/fuzz/found/:
	@mkdir -p $@
$(fuzz_sources:%.cpp=$(B)/fuzz/%.o): $(B)/fuzz/%.o: %.cpp $(wildcard common/base/*.h common/model/*.h common/results/*.h common/solid/*.h common/signal/*.h common/system/*.h common/dynamics/*.h common/studies/*.h common/io/*.h common/io/rexs/*.h) | $(filter deps-fuzz,$(goals)) $(with_deps)
	@mkdir -p $(@D)
	clang++ $(CPPFLAGS) $(HDF5_CFLAGS) $(fuzz_flags) -c -o $@ $<

$(fuzz_targets:%=$(B)/fuzz/whine-fuzz-%): $(B)/fuzz/whine-fuzz-%: tests/fuzz/file_of.h $(fuzz_sources:%.cpp=$(B)/fuzz/%.o)
$(B)/fuzz/whine-fuzz-scene: tests/fuzz/scene.cpp
$(B)/fuzz/whine-fuzz-study: tests/fuzz/study.cpp
$(B)/fuzz/whine-fuzz-rexs: tests/fuzz/rexs.cpp
$(B)/fuzz/whine-fuzz-transfer: tests/fuzz/transfer.cpp
$(B)/fuzz/whine-fuzz-artifact $(B)/fuzz/whine-fuzz-sealed: tests/fuzz/artifact.cpp
$(B)/fuzz/whine-fuzz-sealed: tests/fuzz/edit.cpp
$(fuzz_targets:%=$(B)/fuzz/whine-fuzz-%): $(B)/fuzz/whine-fuzz-%:
	clang++ $(CPPFLAGS) $(HDF5_CFLAGS) -Itests $(fuzz_flags) $(if $(filter sealed,$*),-DSEALED) -o $@ $(filter %.cpp %.o,$^) -lpugixml -lz -lzip -ljsoncpp -lsndfile $(shell pkg-config --libs-only-L hdf5) -lhdf5_hl $(shell pkg-config --libs hdf5 libcrypto)

# The same targets without libFuzzer; tests/fuzz.sh runs them if they are there.
.PHONY: replay
replay: $$(replays) ## the same readers against the same damaged files every time, without libFuzzer
	@B=$(B) bash tests/fuzz.sh
replays := $(fuzz_targets:%=$(B)/bin/whine-replay-%)
$(B)/bin/whine-replay-scene: tests/fuzz/scene.cpp $(call linked,scene)
$(B)/bin/whine-replay-study: tests/fuzz/study.cpp $(call linked,study)
$(B)/bin/whine-replay-rexs: tests/fuzz/rexs.cpp $(call linked,rexs)
$(B)/bin/whine-replay-transfer: tests/fuzz/transfer.cpp $(call linked,transfer)
$(B)/bin/whine-replay-artifact $(B)/bin/whine-replay-sealed: tests/fuzz/artifact.cpp $(call linked,artifact)
$(B)/bin/whine-replay-sealed: tests/fuzz/edit.cpp
$(replays): $(B)/bin/whine-replay-%: tests/fuzz/replay.cpp tests/fuzz/file_of.h $(B)/flags $(cold_precompiled).gch | $(B)/bin/ $(with_deps)
	$(CXX) $(CPPFLAGS) $(HDF5_CFLAGS) $(CXXFLAGS) $(COLD_FLAGS) -include $(cold_precompiled) $(if $(filter sealed,$*),-DSEALED) $(LDFLAGS) \
	  -o $@ $(filter %.o %.cpp,$^) $(libraries)

# HDF5 1.10 forgets some memory where it rejects a file: leaks are looked for where it takes no part, neither after each input
# nor at the end.
# The corpus stays as it is: what a run finds new goes to $(B)/fuzz, and a file that breaks a reader to $(B)/fuzz/found.
.PHONY: fuzz
fuzz: $(fuzz_targets:%=$(B)/fuzz/whine-fuzz-%) | $(B)/fuzz/found/ ## feed the readers of scenes, studies, REXS models, transfer functions and artifacts with damaged files, FUZZ_SECONDS=60 each
	@for target in $(fuzz_targets); do \
	  mkdir -p $(B)/fuzz/new-$$target; \
	  case $$target in artifact|sealed) leaks=0 ;; *) leaks=1 ;; esac; \
	  ASAN_OPTIONS=detect_leaks=$$leaks $(B)/fuzz/whine-fuzz-$$target -max_total_time=$(FUZZ_SECONDS) -timeout=10 -detect_leaks=$$leaks -malloc_limit_mb=1024 -rss_limit_mb=2048 -max_len=1048576 \
	    -print_final_stats=1 -artifact_prefix=$(B)/fuzz/found/$$target- $(B)/fuzz/new-$$target tests/fuzz/corpus/$$target > $(B)/fuzz/$$target.log 2>&1 || \
	    { status=$$?; tail -n 30 $(B)/fuzz/$$target.log >&2; exit $$status; }; \
	  echo "fuzz: $$target: $$(sed -n 's/^stat::number_of_executed_units: *//p' $(B)/fuzz/$$target.log) inputs, no crash, no hang, no more than 1 GiB taken"; \
	done
