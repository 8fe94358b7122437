# SPDX-License-Identifier: Apache-2.0
"""The scenes of the comparison by name."""
import functools

import drawn
import effects
import everyday
import hard
import homes
import interiors
import scenes
import venues

SCENES = {"cornell": scenes.cornell, "sky_room": scenes.sky_room, "sun_room": scenes.sun_room,
          "glossy": scenes.glossy, "glass_shadows": functools.partial(scenes.glass, True),
          "glass_caustics": functools.partial(scenes.glass, False), "exterior": scenes.exterior,
          "day_room": interiors.day_room, "night_room": interiors.night_room,
          "bathroom": interiors.bathroom, "door_ajar": hard.door_ajar, "pool": hard.pool,
          "kitchen": everyday.kitchen, "product": everyday.product, "street": everyday.street,
          "office": everyday.office, "loft": everyday.loft, "papered": everyday.papered,
          "park": everyday.park, "apartment": homes.apartment,
          "lamplit_apartment": homes.lamplit_apartment, "shop": homes.shop, "bedroom": homes.bedroom,
          "villa": homes.villa, "still_life": effects.still_life, "dusk": effects.dusk,
          "fog": effects.fog, "mist": effects.mist, "moving": effects.moving, "passing": effects.passing,
          "frosted": effects.frosted, "atrium": effects.atrium,
          "gallery": venues.gallery, "lounge": venues.lounge, "blinds": venues.blinds,
          "gems": venues.gems, "terrace": venues.terrace}
# With scenes that are compared only if they are named.
ALL = {**SCENES, **{f"drawn_{k}": functools.partial(drawn.scene, k) for k in range(1, 1000)}}
