/* BUILD
   math: vector ggx
   module f32x2: CHANNELS=2
*/
#define PARAMETERS(_) \
    _(int, size)     /* of the table along both axes */ \
    _(int, samples)  /* an entry */
#define BINDINGS(_) \
    _(WRITE, 0, f32x2, split_sum)
