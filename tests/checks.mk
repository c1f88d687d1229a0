# What machine and input may do to a result: sanitizers, faults, fuzzing, numbers under stress, static checks.
#
#   make test-sanitize        the tests of the programs' parts under ASan, UBSan and -D_GLIBCXX_ASSERTIONS, without the slow ones
#   make test-faults          kills, full disks, damaged files, two makes at once; FAULT_KILLS=50
#   make fuzz                 FUZZ_SECONDS=60 for each reader, from the corpus in tests/fuzz/corpus
#   make stress               contact problems and whole scenes by the thousand; STRESS_PROBLEMS, STRESS_SCENES
#   make test-report          reports of whole scenes, their pages in a headless browser
#   make lint                 clang-tidy of common/ and tools/, include direction of the layers, sizes of files and functions, shellcheck

.PHONY: deps-lint deps-fuzz deps-bench deps-slurm deps-browser
deps-bench: wanted := libsiconos-numerics-dev calculix-ccx
deps-bench: | $(with_deps) ## install the packages that only `bench` and the tests beside Siconos use
	$(install_wanted)
deps-slurm: wanted := munge slurmctld slurmd slurm-client
deps-slurm: | $(with_deps) ## install the packages that only `test-slurm` uses
	$(install_wanted)
deps-browser: wanted := chromium
deps-browser: | $(with_deps) ## install the browser that only `test-report` uses
	$(install_wanted)
deps-lint: wanted := clang clang-tidy clang-format shellcheck
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

.PHONY: test-report
test-report: build $(tools:%=$(B)/id/%) | $(with_deps) $(filter deps-browser,$(goals)) ## reports of FZG and NASA gears at coarse settings: known numbers, figures, pages in a headless browser
	@B=$(B) MAKEFLAGS= MAKELEVEL= bash tests/report.sh | tee $(B)/report.log; ! grep -q '^FAILED' $(B)/report.log

# --- clusters

.PHONY: test-slurm
test-slurm: build $(tools:%=$(B)/id/%) | $(with_deps) $(filter deps-slurm,$(goals)) ## a study on a Slurm cluster of one node, made on the loopback device: the same bytes as here
	@B=$(B) SLURM=run MAKEFLAGS= MAKELEVEL= bash tests/slurm.sh | tee $(B)/slurm.log; ! grep -q -E '^(FAILED|skipped)' $(B)/slurm.log

# --- numbers under stress

STRESS_PROBLEMS ?= 1000000
STRESS_SCENES ?= 200
STRESS_SEED ?= 1

.PHONY: stress
stress: $(B)/bin/whine-stress-contact build ## a million contact problems and 200 random scenes: a certificate, a closed energy balance or an error that says why; STRESS_PROBLEMS, STRESS_SCENES
	@$< $(STRESS_PROBLEMS) $(STRESS_SEED)
	@B=$(B) tests/stress/scenes.sh $(STRESS_SCENES) $(STRESS_SEED)

# --- static checks

lint_scripts := $(wildcard tests/*.sh tests/*/*.sh pipelines/*.sh) tests/run .ci/run
with_deps_lint := $(with_deps) $(filter deps-lint,$(goals))

# By this name clang's analyzer knows that sources are included by the one that it reads, and begins paths in them.
lint_folder := $(B)/lint/UnifiedSources
.PHONY: lint
check-format: | $(with_deps_lint)
lint: check-format ## clang-tidy (.clang-tidy says which checks and why), include direction of the layers, sizes of files and functions, shellcheck
	@mkdir -p $(lint_folder)
	@$(call configure,$(lint_folder),-DCMAKE_CXX_COMPILER=clang++ -DARCH= -DLINT=ON)
	@$(call ninja,$(lint_folder),-k 0 lint)
	@shellcheck $(lint_scripts)
	@for test in layers sizes; do B=$(B) bash tests/$$test.sh | tee $(B)/lint/$$test; done; ! grep -q '^FAILED' $(B)/lint/layers $(B)/lint/sizes

# --- fuzzing

FUZZ_SECONDS ?= 60
fuzz_programs := $(fuzz_targets:%=$(B)/fuzz/bin/whine-fuzz-%)
$(B)/fuzz/found/:
	@mkdir -p $@
$(call together,$(fuzz_programs)) &: $(library_sources) $(test_sources) | $(B)/fuzz/found/ $(filter deps-fuzz,$(goals)) $(with_deps)
	@$(call configure,$(B)/fuzz,-DCMAKE_CXX_COMPILER=clang++ -DARCH= -DFUZZ=ON)
	@$(call ninja,$(B)/fuzz,$(fuzz_programs)); touch $(fuzz_programs)

# The same targets without libFuzzer; tests/fuzz.sh runs them if they are there.
.PHONY: replay
replay: $(replays) ## the same readers against the same damaged files every time, without libFuzzer
	@B=$(B) bash tests/fuzz.sh

# HDF5 1.10 forgets some memory where it rejects a file: leaks are looked for where it takes no part, neither after each input
# nor at the end.
# The corpus stays as it is: what a run finds new goes to $(B)/fuzz, and a file that breaks a reader to $(B)/fuzz/found.
.PHONY: fuzz
fuzz: $(fuzz_programs) | $(B)/fuzz/found/ ## feed the readers of scenes, studies, REXS models, transfer functions and artifacts with damaged files, FUZZ_SECONDS=60 each
	@for target in $(fuzz_targets); do \
	  mkdir -p $(B)/fuzz/new-$$target; \
	  case $$target in artifact|sealed) leaks=0 ;; *) leaks=1 ;; esac; \
	  ASAN_OPTIONS=detect_leaks=$$leaks $(B)/fuzz/bin/whine-fuzz-$$target -max_total_time=$(FUZZ_SECONDS) -timeout=10 -detect_leaks=$$leaks -malloc_limit_mb=1024 -rss_limit_mb=2048 -max_len=1048576 \
	    -print_final_stats=1 -artifact_prefix=$(B)/fuzz/found/$$target- $(B)/fuzz/new-$$target tests/fuzz/corpus/$$target > $(B)/fuzz/$$target.log 2>&1 || \
	    { status=$$?; tail -n 30 $(B)/fuzz/$$target.log >&2; exit $$status; }; \
	  echo "fuzz: $$target: $$(sed -n 's/^stat::number_of_executed_units: *//p' $(B)/fuzz/$$target.log) inputs, no crash, no hang, no more than 1 GiB taken"; \
	done
