# Paths and numbers that a user gives: make reads `$` and `%` in them, and a shell all that it does not take for a letter. They are
# looked at before anything is expanded, so the Makefile includes this first; $(value) does not expand, and no $(shell) runs before
# `$` is ruled out.
#
# Allowed are letters, digits and . _ - + , @ only, in paths / too, between the words of lists blanks, in changes of a scene and in
# options : and = too. Numbers and words become parts of paths, so a / in them would lead out of their folder. Recipes quote paths as well. LAUNCH, CXX and the flags of the compiler are commands themselves and are not looked at.

# a literal comma for functions
, := ,
names_allowed = letters, digits$(if $(filter $(lists_given) $(options_given),$1),$(,) blanks) and . _ - + , @$(if $(call name_may_slash,$1), /)$(if $(filter $(options_given),$1), : =) only
name_hash := \#
name_open := (
name_close := )
name_backslash := $(subst x,,\x)
name_forbidden := ! " & ' * : ; < = > ? [ ] ^ ` { | } ~ % $(name_hash) $(name_open) $(name_close) $(name_backslash)

name_found = $(strip $(foreach c,$2,$(findstring $c,$1)))
# Whether it is one word without blanks around it.
name_is_word = $(if $(filter 1,$(words $1)),$(and $(findstring x$(strip $1)x,x$1x),$(findstring x$1x,x$(strip $1)x)))
name_shown = $(patsubst MAKECMDGOALS,target,$v)
name_remedy = , and may hold $(names_allowed)$(if $(filter SCENE SCENES STUDY,$1),; rename the file or its folder)$(if $(filter DAMPING,$1),; it is a share of critical damping: 0.05 for 5 %)
define name_newline


endef

# SCENE, SCENES, STUDY, TRANSFER and MODEL are paths, the others numbers and words; none of them has its default yet. What holds a control
# character is not shown: a terminal would obey it.
words_given := SCENE STUDY SHARE TORQUE PHASE DAMPING STATE AT TRANSFER MODEL DB RATE FROM TO WAY JUMP_MAP JUMP_MAP_STEP JUMP_MAP_LOADS_AT JUMP_MAP_CELLS \
  SENSITIVITY SENSITIVITY_FACTOR SENSITIVITY_RATIO SENSITIVITY_STEP HARRIS_DYNAMIC FOLDS_OVER FOLD_FIRST READING_PARTS FAULT_KILLS \
  STRESS_PROBLEMS STRESS_SCENES STRESS_SEED FUZZ_SECONDS LAUNCH_WAIT FREEZE SANITIZE BRANCHES
lists_given := BESIDE STAGE SCENES JUMP_MAP_TORQUES JUMP_MAP_CORNERS JUMP_MAP_MODELS JUMP_MAP_RATIOS FOLD_RATIOS FOLD_TORQUES FOLD_RELIEFS FOLD_CURVE_TORQUES
options_given := AXIS VARIANTS HARRIS_OPTIONS
paths_given := SCENE SCENES STUDY TRANSFER MODEL
# and what may hold a fraction, the name of a stage in a model, a file among the changes of a scene
name_may_slash = $(filter $(paths_given) MAKECMDGOALS SHARE STAGE HARRIS_OPTIONS VARIANTS,$1)
names_given := $(words_given) $(lists_given) $(options_given)
$(foreach v,$(names_given) MAKECMDGOALS,$(if $(findstring $$,$(value $v)),$(error $(name_shown): it holds $$$(call name_remedy,$v))))
# A recipe would go on in a line of its own.
$(foreach v,$(names_given),$(if $(findstring $(name_newline),$($v)),$(error $v: it holds a line break$(call name_remedy,$v))))

name_controls := $(shell printf '%b ' '\01' '\02' '\03' '\04' '\05' '\06' '\07' '\010' '\016' '\017' '\020' '\021' '\022' '\023' \
  '\024' '\025' '\026' '\027' '\030' '\031' '\032' '\033' '\034' '\035' '\036' '\037' '\0177')
$(foreach v,$(names_given) MAKECMDGOALS,$(if $(call name_found,$($v),$(name_controls)),$(error $(name_shown): it holds a control character$(call name_remedy,$v))))
$(foreach v,$(words_given),$(if $($v),$(if $(call name_is_word,$($v)),,$(error $(name_shown)=$($v): it holds blanks$(call name_remedy,$v)))))
name_forbidden_in = $(if $(filter $(options_given),$1),$(filter-out : =,$(name_forbidden)),$(name_forbidden)) $(if $(call name_may_slash,$1),,/)
$(foreach v,$(names_given) MAKECMDGOALS,$(if $(call name_found,$($v),$(call name_forbidden_in,$v)),\
  $(error $(name_shown)=$($v): it holds $(call name_found,$($v),$(call name_forbidden_in,$v))$(call name_remedy,$v))))

# What make and its recipes read to the end: a pipe, a device or a folder has none. STUDY may also be a name.
name_is_file = $(or $(filter-out STUDY,$1),$(filter %.toml,$2))
$(foreach v,$(paths_given),$(foreach f,$($v),$(if $(filter -%,$f),$(error $v=$f: programs take a name that begins with - for an option; write ./$f))\
  $(if $(and $(call name_is_file,$v,$f),$(wildcard $f)),$(if $(shell [ -f '$f' ] && echo file),,$(error $v=$f: it is no regular file; give the path of a file)))))

# $(call plain_stem,variable,path): its file's name becomes a folder, a part of variables and a target.
plain_stem = $(if $(basename $(notdir $2)),$(if $(strip $(foreach c,. + @ $(,),$(findstring $c,$(basename $(notdir $2))))),\
  $(error $1=$2: the name '$(basename $(notdir $2))' becomes a folder and a target$(,) so it may hold letters$(,) digits$(,) _ and - only; rename the file)),\
  $(error $1=$2: the file has no name before .toml; rename the file))
