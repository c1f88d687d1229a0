# Readings of P2000: what the paper leaves open, searched over data/studies/reading*.toml, and which of its claims hold together.
# A part holds whole tooth forms, so that a search that is broken off goes on with those that are missing.

reading_scene := parker2000-standard-tooth
reading_plans := reading reading-shallow reading-deep reading-best
READING_PARTS ?= 8
reading_numbers := $(if $(filter reading consistency docs out/%,$(goals)),$(shell seq -w $(READING_PARTS)))
reading_parts := $(foreach p,$(reading_plans),$(reading_numbers:%=out/reading/$p/part_%.h5))
claim_sets := data/published/claim_sets.toml

part_of = $(lastword $(subst _, ,$(basename $(@F))))
$(reading_parts): data/studies/$$(call part,3).toml data/scenes/$(reading_scene).toml $(printed_claims) $(call id,gear-reading) | $(B)/bin/gear-reading
	@mkdir -p $(@D)
	$(call run,reading) --plan $< --printed $(printed_claims) --part $(part_of)/$(READING_PARTS) --output $@ $(call landed,reading)

out/reading/readings.h5: $(reading_parts) $(call id,gear-reading) | $(B)/bin/gear-reading
	$(B)/bin/gear-reading --output $@ $(filter %.h5,$^)

out/reading/confirmed.h5: out/reading/readings.h5 data/scenes/$(reading_scene).toml $(printed_claims) $(call id,gear-reading) | $(B)/bin/gear-reading
	$(call run,reading) --confirm 20 --printed $(printed_claims) --scene data/scenes/$(reading_scene).toml --output $@ $< $(call landed,reading)

$(call together,$(addprefix out/figures/consistency,.tsv _sets.tsv _best.tsv)) &: out/reading/readings.h5 out/reading/confirmed.h5 $(claim_sets) $(call id,gear-reading) | $(B)/bin/gear-reading
	@mkdir -p out/figures
	$(B)/bin/gear-reading --sets $(claim_sets) --output out/figures/consistency $(filter %.h5,$^)

$(call together,out/figures/reading.tsv out/figures/reading.svg out/figures/reading.png) &: out/reading/readings.h5 $(claim_sets) $(call template,reading) pipelines/plots/common.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	@mkdir -p out/figures
	$(B)/bin/gear-plot reading --claim-sets $(claim_sets) --output out/figures/reading $<

.PHONY: reading consistency docs docs-tables published_tables
reading: out/reading/readings.h5 out/reading/confirmed.h5 ## search over what P2000 leaves open: two thousand readings against its claims, an hour of CPU
consistency: out/figures/consistency_sets.tsv out/figures/reading.png ## which of P2000's claims hold together in one reading, and which in none
	@cat $<
published_tables: out/figures/scorecard.tsv out/figures/consistency_sets.tsv out/figures/consistency_best.tsv out/figures/reading.png
	cp out/figures/scorecard.tsv data/published/scorecard.tsv
	cp out/figures/consistency_sets.tsv data/published/claim_sets.tsv
	cp out/figures/consistency_best.tsv data/published/best_readings.tsv
	cp out/figures/reading.png data/published/reading.png
docs: published_tables docs-tables ## all that is generated in data/published (an hour of CPU for the search over readings), and what docs-tables does
docs-tables: build $(if $(filter docs,$(goals)),published_tables) ## renew data/keys.tsv and the generated tables of the pages (seconds; tests/pages.sh compares)
	pipelines/tables.sh renew $(B)/bin
