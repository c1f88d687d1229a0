# Readings of P2000: what the paper leaves open, searched, and which of its claims hold together.
#
#   make reading        the search over data/studies/reading*.toml, and its best again with strips; out/reading/
#   make consistency    out/figures/consistency{,_sets,_best}.tsv, the sets printed, and the figure out/figures/reading.{tsv,svg,png}
#   make docs           both, and the scorecard, into data/published; and what docs-tables does
#   make docs-tables    data/keys.tsv, and the generated tables of the pages: seconds
#
# A part holds whole tooth forms, so that a search that is broken off goes on with those that are missing.

reading_scene := parker2000-standard-tooth
reading_plans := reading reading-shallow reading-deep reading-best
READING_PARTS ?= 8
reading_numbers := $(shell seq -w $(READING_PARTS))
reading_parts := $(foreach p,$(reading_plans),$(reading_numbers:%=out/reading/$p/part_%.h5))
claim_sets := data/published/claim_sets.toml

define reading_rules # plan
out/reading/$1/part_%.h5: data/studies/$1.toml data/scenes/$(reading_scene).toml $(printed_claims) $(call id,gear-reading) | $(B)/bin/gear-reading
	@mkdir -p $$(@D)
	$$(call run,reading) --plan $$< --printed $(printed_claims) --part $$*/$(READING_PARTS) --output $$@ $$(call landed,reading)
endef
$(foreach p,$(reading_plans),$(eval $(call reading_rules,$p)))

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

# Generated blocks of pages, between <!-- name --> and <!-- end of name -->.
define replace_block # page, name, file
@awk -v name='$2' -v file='$3' '$$0 == "<!-- " name " -->" { print; while ((getline line < file) > 0) print line; skip = 1 } \
  $$0 == "<!-- end of " name " -->" { skip = 0 } !skip' $1 > $1.new && mv $1.new $1
endef

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
	@mkdir -p $(B)/tables
	@for table in keys scenes studies scorecard sets; do pipelines/tables.sh $$table $(B)/bin > $(B)/tables/$$table; done
	cp $(B)/tables/keys data/keys.tsv
	$(call replace_block,data/scenes/README.md,scenes,$(B)/tables/scenes)
	$(call replace_block,data/studies/README.md,studies,$(B)/tables/studies)
	$(call replace_block,data/published/README.md,scorecard,$(B)/tables/scorecard)
	$(call replace_block,data/published/README.md,sets,$(B)/tables/sets)
