# Figures and tables: the paper's in out/figures/, those of SCENE in out/<scene>/report/; a report by its path is of any scene.
# The page of a report, index.html, is made of them and of artifacts, by gear-report.
#
# A new figure is a line of inputs, the paper's torques, a name in the list of figures and a line of help.txt; a gnuplot template
# pipelines/plots/figNN.gp where it is no figure of panels. Figures of one kind share a drawing: same_drawing pairs them.
# shown_at: operating points.

# The reading of P2000 that agrees best; its pair with a standard tooth, as printed and with less damping.
paper_scene := parker2000
standard_scene := parker2000-standard-tooth
calibrated_scene := parker2000-calibrated
paper_scenes := $(paper_scene) $(standard_scene) $(calibrated_scene)
# A deeper root, sharper: what `bench-stress` measures.
deep_scene := parker2000-deep-root
# What figures of motions show below the paper's scene: BESIDE='parker2000-standard-tooth parker2000-calibrated'.
BESIDE ?=
$(if $(filter-out $(paper_scenes),$(BESIDE)),$(error BESIDE=$(BESIDE): it is one or more of $(paper_scenes)))
shown_scenes := $(paper_scene) $(filter-out $(paper_scene),$(BESIDE))
graded_scene := parker2000-grade5
# The standard tooth with tip relief, at both dampings.
relief_scenes := $(foreach s,$(standard_scene) $(calibrated_scene),$(foreach r,20_9 22_2 23_6,$s-relief-$r))
cracked_scene := parker2000-crack
helical_scene := parker2000-helical-0_5
bearing_scene := parker2000-bearings
internal_scene := internal-pair
friction_scene := fzg-c-friction
# of several meshes, of rigid gears
system_scene := lin-parker-planetary
# whose steps bench-train times
train_scene := oh58-planetary

# $(call both_ways,scenes,torques,artifact): sweeps up and down
both_ways = $(foreach s,$1,$(foreach t,$2,$(foreach d,up down,out/$s/T$t/$d/$3.h5)))
# $(call of_gears,scene,artifact): of driver and driven gear
of_gears = $(foreach g,$(SCENE_$1_DRIVER) $(SCENE_$1_DRIVEN),out/$1/$g/$2.h5)
# $(call impacts,scenes,torques): for damping ratios, where there are ring-downs
impacts = $(foreach s,$1,$(if $(filter no,$(SCENE_$s_RINGS_DOWN)),,$(foreach t,$2,out/$s/T$t/impact.h5)))
# ERRORS=yes: with the errors of the motions at the first torque, which take about as long as ten sweeps.
ERRORS ?= no
measured_errors = $(if $(filter yes,$(ERRORS)),$(call both_ways,$1,$(firstword $2),sweep_errors))
# $(call titles,inputs): what figures call the scenes of their inputs
titles = $(sort $(foreach f,$1,out/$(word 2,$(subst /, ,$f))/params/title.txt))
# $(call each,torques): those that get a curve each; six can be told apart
each = $(wordlist 1,6,$1)

# inputs_<figure>: $1 scenes, $2 torques. What is drawn at one torque takes the first.
inputs_fig01 = $(call of_gears,$1,mesh) out/$1/T$(firstword $2)/static.h5
inputs_fig03 = $(inputs_fig01)
inputs_fig05 = $(call both_ways,$1,$(firstword $2),response) $(call impacts,$1,$(firstword $2)) $(call measured_errors,$1,$2)
inputs_fig07 = $(call both_ways,$1,$(call each,$2),response) $(call impacts,$1,$(call each,$2)) $(call measured_errors,$1,$2)
# The same with the orbits that no sweep finds.
inputs_fig05-branches = $(inputs_fig05) $(foreach s,$1,out/$s/T$(firstword $2)/branch.h5)
inputs_fig07-branches = $(inputs_fig07) $(foreach s,$1,$(foreach t,$(call each,$2),out/$s/T$t/branch.h5))
# Of a train without its ring-downs.
inputs_histories = $(call both_ways,$1,$(firstword $2),sweep) $(if $(call is_pair,$1),$(call impacts,$1,$(firstword $2)))
inputs_multipliers = out/$1/T$(firstword $2)/branch.h5
inputs_fig08 = $(call both_ways,$1,$(firstword $2),sweep) $(call impacts,$1,$(firstword $2))
inputs_fig12 = $(foreach t,$(call each,$2),out/$1/T$t/static.h5)
inputs_waterfall = $(call both_ways,$1,$(firstword $2),sweep)
# What order cuts are made from.
inputs_order-cuts = $(call both_ways,$1,$(firstword $2),response)
inputs_face-load = $(call both_ways,$1,$(firstword $2),response)
inputs_bearing-forces = $(call both_ways,$1,$(firstword $2),response) $(call impacts,$1,$(firstword $2))
inputs_fig14 = $(foreach t,$(call each,$2),$(call both_ways,$1,$t/rectangular,sweep))
inputs_fig15 = $(foreach m,rectangular-fig15 rectangular,out/$1/T$(firstword $2)/$m/down/sweep.h5)
inputs_fig16 = $(foreach t,$(call each,$2),$(call both_ways,$1,$t/secant,sweep))
inputs_flank-load = out/$1/T$(firstword $2)/static.h5
inputs_profile-chart = out/$1/T$(firstword $2)/static.h5
inputs_error-budget = out/$1/T$(firstword $2)/error_budget.h5
inputs_motion-errors = $(call both_ways,$1,$(firstword $2),sweep_errors)
inputs_sidebands = out/$1/T$(firstword $2)/static.h5 out/$1/T$(firstword $2)/up/response.h5
inputs_root-stress = out/$1/T$(firstword $2)/static.h5 $(call both_ways,$1,$(firstword $2),response)
inputs_root-stress-branches = $(inputs_root-stress) out/$1/T$(firstword $2)/branch.h5
inputs_efficiency = $(foreach t,$(call each,$2),out/$1/T$t/static.h5 $(call both_ways,$1,$t,response))
inputs_crack = out/$1/T$(firstword $2)/static.h5
inputs_residual-signal = $(foreach kind,sweep response,out/$1/T$(firstword $2)/up/$(kind).h5)
# Of systems: trains, planetary trains.
inputs_system-static = out/$1/T$(firstword $2)/static.h5
inputs_system = $(if $2,$(inputs_system-static),$(inputs_modes))
inputs_modes = out/$1/modes.h5
inputs_campbell = $(inputs_modes)
inputs_system-sweep = $(call both_ways,$1,$(firstword $2),response)
inputs_ring-down = out/$1/T$(firstword $2)/impact.h5
inputs_branch = out/$1/T$(firstword $2)/branch.h5 $(inputs_system-sweep)
inputs_table1 = $(foreach t,$2,out/$1/T$t/impact.h5)
# Figures of a scene are called by what they show, those of P2000 by their numbers there: `make SCENE=own.toml fig12` is out/own/report/transmission-error.
shown_names := fig01:finite-elements fig03:contact-zone fig05:response fig05-branches:response-branches fig07:responses-by-torque fig07-branches:responses-by-torque-branches \
  fig12:transmission-error fig13:mesh-stiffness fig14:lumped-rectangular fig14-elastic:rms-and-mean fig16:lumped-by-torque
shown_as = $(if $(SCENE),$(call paired,$1,$(shown_names)),$1)
# Those that are made from what another one is made from, and those that are drawn as another one.
same_inputs := fig07-600:fig07 fig09:fig08 fig10:fig08 fig11:fig08 fig13:fig12 load-sharing:fig12 tooth-loads:fig08 fig14-elastic:fig07 relief-jumps:fig05 \
  flank-pressure:root-stress runup-down:runup-up history-loads:fig08
same_drawing := fig07:fig05 fig07-600:fig05 fig05-branches:fig05 fig07-branches:fig05 fig09:fig08 fig11:fig10 fig14:fig16 fig14-elastic:fig16 profile-chart:profile \
  relief-jumps:fig05 root-stress-branches:root-stress histories:fig08 history-loads:fig10 runup-up:runup runup-down:runup
paired = $(or $(patsubst $1:%,%,$(filter $1:%,$2)),$1)
numbered = $(or $(patsubst %:$1,%,$(filter %:$1,$(shown_names))),$1)
drawn_as = $(call paired,$(call numbered,$1),$(same_drawing))
# Figures of panels have no template of their own.
template = $(or $(wildcard pipelines/plots/$1.gp),pipelines/plots/panels.gp)
# $(call inputs,figure,scenes,torques)
inputs = $(call inputs_$(call paired,$(call numbered,$1),$(same_inputs)),$2,$3)


# Mesh frequencies in Hz: P2000's, its upper and lower branch, or time histories at one of the sweep's, figures of their own for each.
shown_at := fig08:2400 fig10:2400 fig09:1300 fig11:1300 fig15:2200$(,)2150
options = $(patsubst $1:%,--mesh-frequency %,$(filter $1:%,$(shown_at) histories:$(AT) history-loads:$(AT)))
history_figures = $(foreach f,histories $(if $(filter train,$(SCENE_$(own_scene)_KIND)),,history-loads),$(figure_folder)/$f-$(AT)Hz-T$(TORQUE))

beside_figures := fig05 fig07 fig05-branches fig07-branches fig07-600 fig08 fig09 fig10 fig11 fig14-elastic
paper_scenes_flank-load := $(helical_scene)
paper_scenes_face-load := $(helical_scene)
paper_scenes_sidebands := $(graded_scene)
paper_scenes_crack := $(cracked_scene)
paper_scenes_residual-signal := $(cracked_scene)
paper_scenes_bearing-forces := $(bearing_scene)
paper_scenes_efficiency := $(friction_scene)
paper_scenes_profile-chart := $(firstword $(relief_scenes))
paper_scenes_relief-jumps := $(standard_scene) $(calibrated_scene) $(relief_scenes)
at_150 := flank-load face-load profile-chart relief-jumps waterfall order-cuts tooth-loads root-stress root-stress-branches flank-pressure bearing-forces fig03 fig05 fig05-branches multipliers fig08 fig09 fig10 fig11 fig15 error-budget motion-errors sidebands crack residual-signal
paper_torques = $(if $(filter $(at_150),$1),150,$(if $(filter fig07-600,$1),300 600,100 200 300))

report_figures := fig01 fig03 fig05 fig07 fig12 fig13 fig14 fig14-elastic fig16
# at the paper's own speeds, torques or levels
paper_only := fig07-600 fig08 fig09 fig10 fig11 fig15
paper_figures := $(sort $(report_figures) $(paper_only))
# of any pair, none of the paper's
other_figures := fig05-branches fig07-branches multipliers load-sharing waterfall order-cuts tooth-loads root-stress root-stress-branches flank-pressure efficiency bearing-forces error-budget motion-errors profile-chart flank-load face-load sidebands crack residual-signal
figures := $(paper_figures) $(other_figures) relief-jumps
inputs_of_paper = $(call inputs,$1,$(or $(paper_scenes_$1),$(if $(filter $(beside_figures),$1),$(shown_scenes)),$(paper_scene)),$(paper_torques))

printed_claims := data/published/claims.toml
# What gear-scorecard --files lists, of both scenes of the paper.
scorecard_files := $(foreach t,100 150 200 300 600,T$t/static.h5 T$t/up/response.h5 T$t/down/response.h5) \
  $(foreach t,100 150 200 300,T$t/impact.h5 T$t/rectangular/up/response.h5 T$t/rectangular/down/response.h5) \
  $(foreach t,100 200 300,T$t/secant/up/response.h5 T$t/secant/down/response.h5) \
  T150/up/sweep.h5 T150/down/sweep.h5 T150/rectangular/up/sweep.h5
inputs_scorecard := $(foreach s,$(paper_scenes),$(scorecard_files:%=out/$s/%))

figure_inputs = $(if $(filter bifurcations,$(goals)),$(bifurcation_branches)) $(foreach f,$(figures) table1,$(call inputs_of_paper,$f)) $(inputs_scorecard)

$(if $(SCENE),$(foreach f,$(filter $(paper_only) relief-jumps,$(goals)),\
  $(error $f shows the paper at speeds, torques, levels or reliefs of its own; for SCENE there are $(report_figures) $(other_figures) table1)))

$(call together,$(addprefix out/figures/scorecard.,tsv txt)) &: $(inputs_scorecard) $(printed_claims) data/published/fitted.toml $(call id,gear-scorecard) | $(B)/bin/gear-scorecard $(with_deps)
	$(B)/bin/gear-scorecard --printed $(printed_claims) --fitted data/published/fitted.toml --output out/figures/scorecard $(inputs_scorecard)

figure_folder := $(if $(SCENE),out/$(basename $(notdir $(SCENE)))/report,out/figures)
# AXIS=rpm:pinion: the speed of a gear, of a train also of its carrier, in place of the mesh frequency; DB=1e-6: RMS of the DTE and of its orders in dB re this length in m.
AXIS ?=
DB ?=
speed_figures := $(foreach f,fig05 fig05-branches fig07 fig07-branches fig14 fig14-elastic fig16,$(call paired,$f,$(shown_names))) fig05 fig07 fig05-branches fig07-branches fig07-600 fig14 fig14-elastic fig16 relief-jumps waterfall order-cuts residual-signal tooth-loads face-load bearing-forces efficiency root-stress root-stress-branches flank-pressure compare-motion runup-up runup-down campbell system-sweep branch
level_figures := order-cuts waterfall compare-motion runup-up runup-down system-sweep branch
# A figure that would not take them is not drawn without them; `modes` draws the Campbell diagram, too, `branches` its figure, and `sweep`
# that of a train.
not_drawn_with = $(filter-out $1,$(filter $(figures) table1 static impact histories multipliers fold-curves jump-map sensitivity harris-map modes \
  animation study reading work-precision,$(goals)))
$(if $(AXIS),$(if $(call not_drawn_with,modes $(speed_figures)),$(error AXIS=$(AXIS): $(firstword $(call not_drawn_with,modes $(speed_figures))) \
  is not drawn against the speed of a gear; leave AXIS out. It is for $(filter-out compare-motion runup-up runup-down campbell branch system-%,$(speed_figures))$(,) modes$(,) runup$(,) compare$(,) report$(,) branches$(,) of a train sweep)))
$(if $(DB),$(if $(call not_drawn_with,$(level_figures)),$(error DB=$(DB): $(firstword $(call not_drawn_with,$(level_figures))) \
  is not drawn in dB; leave DB out. It is for order-cuts$(,) waterfall$(,) runup$(,) compare$(,) report$(,) branches$(,) of a train sweep)))
axis_options = $(strip $(if $(AXIS),$(if $(filter $1,$(speed_figures)),--axis '$(AXIS)')) $(if $(DB),$(if $(filter $1,$(level_figures)),--db $(DB))))

# Figures, by the path out/$1 of a file without its ending: out/S/report/fig05, out/figures/histories-1300Hz-T150. Those of a scene depend on its
# fragment, too, which says its torques: not only on what stands at each.
figure_of = $(or $(strip $(foreach f,histories history-loads compare-rest compare-motion fold-curves harris-map,$(if $(filter $f-%,$(notdir $1)),$f))),\
  $(if $(filter runup-%,$(notdir $1)),runup-$(WAY)),$(patsubst harris-dynamic,harris-map,$(patsubst %-fine,%,$(notdir $1))))
scene_of_figure = $(patsubst %/report/,%,$(filter %/report/,$(dir $1)))
inputs_of_figure = $(if $(filter compare/%,$1),$(call inputs,$2,$(compared),$(compared_torque)),$(if $(filter histories history-loads runup-%,$2),$(call inputs,$2,$(own_scene),$(TORQUE)),\
  $(if $3,$(if $(if $(call is_pair,$3),$(filter-out system-% modes campbell,$2),$(filter $2,$(system_figures))),$(call inputs,$2,$3,$(SCENE_$3_TORQUES))),$(call inputs_of_paper,$2))))
drawing = $(call drawn_as,$2)
fragments = $(foreach s,$(or $3,$(if $(filter compare/%,$1),$(compared))),$(B)/scenes/$s.mk)
of_figure = $(call $1,$2,$(call figure_of,$2),$(call scene_of_figure,$2))
needs_of_figure = $(or $(strip $(inputs_of_figure)),no-such-figure) $(fragments) $(call titles,$(inputs_of_figure)) $(call template,$(drawing)) $(axis_plan)
# Only figures that have the choice remember it.
axis_plan = $(if $(filter $2,$(speed_figures)),$(B)/plans/axes/out/$1)
# Each program publishes its files together, whole or as they were: make, which has not looked at the times of all of them, leaves them if it fails.
.PRECIOUS: out/%.tsv out/%.svg out/%.png out/%.wav out/%/table1.tsv out/%/table1.txt $(B)/plans/axes/%
out/%.tsv out/%.svg out/%.png: $$(call of_figure,needs_of_figure,$$*) pipelines/plots/common.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(strip $(B)/bin/gear-plot $(call of_figure,drawing,$*) --output out/$* $(call options,$(call figure_of,$*)) $(call axis_options,$(call figure_of,$*)) $(if $(filter figures/fig%,$*),--paper-figure $(notdir $*)) $(filter %.h5,$+))
plan_of_axes = $(strip figure $(subst ',,$(call axis_options,$(call figure_of,$@))) $(if $(filter yes,$(ERRORS)),$(filter fig05 fig07 response responses-by-torque,$(call figure_of,$@))))
$(B)/plans/axes/%: $$(call differs,$$@,$$(plan_of_axes))
	$(call write_plan,$(plan_of_axes))

# Heard at a speed of the user's choice, the rising branch first, or of a run-up, then of the run-down over the same speeds; with a
# transfer function a file of its own.
sound_file = $(figure_folder)/sound-$(if $(sound_of_runup),runup-$(subst _,-,$(runup_stem)),$(AT)Hz)-T$(TORQUE)$(if $(MESH),-$(MESH))$(if $(TRANSFER),-$(basename $(notdir $(TRANSFER))))
# Path and content: a transfer function of the same name in another folder may be older than the sound of the first.
sound_plan_file = $(if $(TRANSFER),$(B)/plans/$(own_scene)/$(notdir $(sound_file)))
sound_plan = --transfer $(TRANSFER) $(firstword $(shell sha256sum 2>/dev/null < '$(TRANSFER)'))
sound_inputs = $(if $(sound_of_runup),out/$1/T$(TORQUE)/up/runup_$(runup_stem).h5 out/$1/T$(TORQUE)/down/runup_$(RATE)$(if $(FROM),_$(TO)_$(FROM)).h5,$(call both_ways,$1,$(TORQUE),sweep))
out/%.wav: $$(call sound_inputs,$$(own_scene)) $(TRANSFER) $$(sound_plan_file) $(call id,gear-sound) | $(B)/bin/gear-sound $(with_deps)
	$(B)/bin/gear-sound $(patsubst %,$(if $(sound_of_runup),--runup,--sweep) %,$(filter %.h5,$^)) $(if $(sound_of_runup),,--mesh-frequency $(AT)) $(if $(MESH),--mesh '$(MESH)') $(if $(TRANSFER),--transfer '$(TRANSFER)') --output out/$*

# Results beside the REXS model that the scene was imported from. Path, stage and content, as for a sound.
export_file = $(figure_folder)/$(basename $(notdir $(MODEL)))-results$(suffix $(MODEL))
export_plan_file = $(B)/plans/$(own_scene)/$(notdir $(export_file)).export
export_plan = --model $(MODEL) --stage $(STAGE) $(firstword $(shell sha256sum 2>/dev/null < '$(MODEL)'))
export_inputs = $(foreach t,$2,out/$1/T$t/static.h5) $(call impacts,$1,$2) $(call both_ways,$1,$2,response)
ifneq ($(filter export,$(goals)),)
$(export_file): $$(call export_inputs,$$(own_scene),$$(SCENE_$$(own_scene)_TORQUES)) $(MODEL) $$(export_plan_file) out/$$(own_scene)/params/title.txt $(call id,gear-export) | $(B)/bin/gear-export $(with_deps)
	$(B)/bin/gear-export --model '$(MODEL)' $(if $(STAGE),--stage '$(STAGE)') --output $@ $(filter %.h5,$^)
endif
plans_of_figures = $(if $(filter sound,$(goals)),$(sound_plan_file)) $(if $(filter export,$(goals)),$(export_plan_file))
plan_of_figure = $(if $(filter $@,$(sound_plan_file)),$(sound_plan),$(if $(filter $@,$(export_plan_file)),$(export_plan)))

# A run-up with the sweeps beside it.
runup_figure = $(figure_folder)/runup-$(subst _,-,$(runup_stem))-$(WAY)-T$(TORQUE)
inputs_runup-up = out/$1/T$2/$(WAY)/runup_$(runup_stem).h5 $(call both_ways,$1,$2,response)

# out/figures/table1, out/S/report/table1
printed_beside = $(if $(filter figures,$1),$(printed_claims))
out/%/table1.tsv out/%/table1.txt: $$(call inputs_of_figure,$$*,table1,$$(call scene_of_figure,$$*/)) $$(call printed_beside,$$*) $$(call fragments,,,$$(call scene_of_figure,$$*/)) $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot table1 $(patsubst %,--printed %,$(call printed_beside,$*)) --output out/$*/table1 $(filter %.h5,$^)

# 2400 Hz is where P2000 shows two branches at 150 N m; of a scene it is its first torque and the speed with the largest RMS.
digits := 0 1 2 3 4 5 6 7 8 9
animation_frames := $(wordlist 2,49,$(foreach t,0 1 2 3 4,$(foreach u,$(digits),0$t$u)))
animated_scene = $(or $(call scene_of_figure,$1/),$(calibrated_scene))
animated_sweep = out/$2/T$(if $(filter figures,$1),150,$(firstword $(SCENE_$2_TORQUES)))/down/sweep.h5
animation_needs = $(call of_gears,$2,mesh) $(animated_sweep) out/$2/params/title.txt $(if $(filter figures,$1),,$(B)/scenes/$2.mk)
animation_files := $(addprefix out/%/animation/motion,.tsv .gif $(patsubst %,-%.png,$(animation_frames)))
.PRECIOUS: $(animation_files)
$(animation_files): $$(call animation_needs,$$*,$$(call animated_scene,$$*)) \
    pipelines/plots/animation.gp pipelines/plots/common.gp $(call id,gear-animate) | $(B)/bin/gear-animate $(with_deps)
	$(call run,animate) $(call named,--mesh,$(call animated_scene,$*),mesh) --sweep $(filter %/sweep.h5,$^) $(if $(filter figures,$*),--mesh-frequency 2400) --frames $(words $(animation_frames)) --output out/$*/animation/motion $(call landed,animate)

# A report shows what there is of a scene: of a system with planets their load sharing, of one in motion its sweeps; of a pair with teeth
# that differ or are cracked no figure of one mesh period.
teeth = $(filter $2,$(SCENE_$1_TEETH))
# BRANCHES=yes: with the branch at the first torque, which takes about as long as four sweeps.
BRANCHES ?= no
system_figures := histories system system-static load-sharing error-budget flank-load modes campbell system-sweep motion-errors order-cuts residual-signal ring-down branch multipliers harris-map fold-curves
over_face = $(filter slices body,$(SCENE_$1_WIDTH))
moves = $(filter yes,$(SCENE_$1_MOVES))
branched = $(if $(call teeth,$1,alike),$(filter yes,$(BRANCHES)))
budgeted = $(and $2,$(call teeth,$1,alike))
pair_at_rest = finite-elements $(if $(filter yes,$(SCENE_$1_MODIFIED)),profile-chart) $(if $(call teeth,$1,alike),transmission-error mesh-stiffness load-sharing) \
  $(if $(call over_face,$1),flank-load) $(if $(call teeth,$1,cracked),$(if $(call teeth,$1,differ),,crack)) $(if $(filter yes,$(SCENE_$1_FRICTION)),efficiency) \
  $(if $(filter elastic,$(SCENE_$1_BEARINGS)),bearing-forces) $(if $(call teeth,$1,differ),sidebands)
pair_in_motion = responses-by-torque $(if $(call branched,$1),response-branches) waterfall tooth-loads $(if $(call over_face,$1),face-load,$(if $(call teeth,$1,alike),root-stress))
train_at_rest = $(if $2,system-static $(if $(filter yes,$(SCENE_$1_PLANETS)),load-sharing) $(if $(call over_face,$1),flank-load)) modes campbell
train_in_motion = system-sweep $(if $(call branched,$1),branch)
of_kind_in = $(call $(if $(call is_pair,$2),pair,train)_$1,$2,$3)
report_shows = system $(call of_kind_in,at_rest,$1,$2) $(if $(call budgeted,$1,$2),error-budget) $(if $(call moves,$1),$(call of_kind_in,in_motion,$1) order-cuts $(if $(call branched,$1),multipliers) \
  $(if $(or $(call teeth,$1,alike),$(call over_face,$1)),,residual-signal))
report_artifacts = $(foreach t,$2,out/$1/T$t/static.h5) $(if $(call budgeted,$1,$2),out/$1/T$(firstword $2)/error_budget.h5) $(if $(call is_pair,$1),$(call impacts,$1,$2),out/$1/modes.h5) \
  $(if $(call moves,$1),$(call both_ways,$1,$2,response) $(call measured_errors,$1,$2))
of_report = $(call report_$1,$2,$(SCENE_$2_TORQUES))
page_inputs = $(call of_report,artifacts,$1) $(patsubst %,out/$1/report/%.png,$(call of_report,shows,$1))
# $(call report_figure,scene,figures)
report_figure = $(foreach f,$2,$(foreach e,tsv svg png,out/$1/report/$f.$e))
.PRECIOUS: out/%/report/index.html out/%/report/results.tsv
out/%/report/index.html out/%/report/results.tsv: $$(call page_inputs,$$*) out/%/params/title.txt $(B)/scenes/%.mk $(call id,gear-report) | $(B)/bin/gear-report $(with_deps)
	$(B)/bin/gear-report --output $(@D)/index.html $(filter %.h5 %.png,$+)

# What the teeth suffer at one torque: that of its figures, the first of SCENE or the paper's.
teeth_shows = root-stress $(if $(filter yes,$(BRANCHES)),root-stress-branches) flank-pressure load-sharing tooth-loads error-budget
teeth_inputs = $(call report_artifacts,$1,$3) $(patsubst %,$2/%.png,$(teeth_shows))
teeth_scene = $(patsubst figures,$(paper_scene),$1)
teeth_needs = $(if $(filter $2,$(systems)),$(call of_report,artifacts,$2),$(call teeth_inputs,$2,$(if $(filter figures,$1),out/figures,out/$2/report),$(if $(filter figures,$1),$(call paper_torques,root-stress),$(firstword $(SCENE_$2_TORQUES)))))
out/%/teeth/index.html: $$(call teeth_needs,$$*,$$(call teeth_scene,$$*)) out/$$(call teeth_scene,$$*)/params/title.txt $(B)/scenes/$$(call teeth_scene,$$*).mk $(call id,gear-report) | $(B)/bin/gear-report $(with_deps)
	$(B)/bin/gear-report --teeth --output $@ $(filter %.h5 %.png,$+)
teeth_page := out/$(if $(SCENE),$(basename $(notdir $(SCENE))),figures)/teeth/index.html

# $(call stands,words): where a goal is to be found, also when nothing was to be made. By $(info): `make -q` and `make -n` stay as they are.
stands = $(if $(findstring n,$(firstword -$(MAKEFLAGS)))$(findstring q,$(firstword -$(MAKEFLAGS))),,$(info $1))

.PHONY: figures teeth $(figures) table1 scorecard animation report export histories sound runup
report: out/$$(own_scene)/report/index.html ## figures, tables and one HTML page of SCENE (default: the paper's), out/<scene>/report/index.html; BRANCHES=yes, ERRORS=yes
	$(call stands,report: open $< in a browser; results.tsv beside it holds its numbers)
export: $(if $(filter export,$(goals)),$$(export_file)) ## results of SCENE as custom attributes of a copy of the REXS model that it was imported from: MODEL=stage.rexs STAGE=12 (id or name; where it has several)
	$(call stands,export: $(export_file))
$(figures): %: $$(foreach e,tsv svg png,$(figure_folder)/$$(call shown_as,$$*).$$e)
teeth: $(teeth_page) ## what the teeth suffer, on one page, out/figures/teeth/index.html (SCENE, a train too: out/<scene>/teeth/index.html): root stress, flank pressure, dynamic factors, losses beside ISO 6336, 150 N m (SCENE: its first torque); BRANCHES=yes
	$(call stands,teeth: open $< in a browser)
figures: $(if $(SCENE),$(report_figures),$(paper_figures)) $(figure_folder)/table1.txt ## all figures and tables of the paper that are there so far, or all of SCENE
table1: $(figure_folder)/table1.txt ## natural frequencies by ring-down at 100, 200 and 300 N m beside those of the paper (SCENE: its torques)
	@cat $<
scorecard: out/figures/scorecard.txt ## every number and statement of the paper, its value in three scenes of its pair, whether it agrees
	@cat $<
histories: $(if $(filter histories,$(goals)),$$(addsuffix .png,$$(history_figures))) ## DTE over time, its spectrum and the tooth loads (of a train mesh and bearing forces) at one mesh frequency in Hz, both branches: AT=1300 TORQUE=150 (SCENE: its first torque)
	$(call stands,histories: $(addsuffix .{png$(,)svg$(,)tsv},$(history_figures)))
sound: $(if $(filter sound,$(goals)),$$(sound_file).wav) ## what is heard of the mesh force at one mesh frequency in Hz, rising branch, then falling, as WAV: AT=2400; or of a run-up, then a run-down: RATE=100 (rpm/s) FROM=2400 TO=2800; TORQUE=150 TRANSFER=file.csv (SCENE: its first torque; of a train the first mesh, or MESH=sun-planet2)
	$(call stands,sound: $(sound_file).{wav$(,)tsv})
runup: $(if $(filter runup,$(goals)),$$(runup_figure).png) ## run-up or run-down: spectrogram of the mesh force, orders of the DTE, tooth loads: RATE=100 (rpm/s) WAY=up FROM=2400 TO=2800 (Hz; else the scene's speeds) TORQUE=150 (SCENE: its first torque)
	$(call stands,runup: $(runup_figure).{png$(,)svg$(,)tsv})
animation: $(figure_folder)/animation/motion.gif ## one mesh period with contact loss, GIF and a PNG of each frame, 150 N m, 2400 Hz, upper branch of parker2000-calibrated (SCENE: first torque, at resonance)
