// State of unfinished pixels between dispatches. The slots of a block lie together, and of these the same word: neighbours' loads are
// contiguous and a block stays within a few memory pages.

layout(std430, binding = MINIRT_BINDING_STATE) buffer StateBuffer { uint state[]; };

uint stateIndex(uint slot, uint word) { return ((slot >> 6) * frame.blocks.w + word) * 64u + (slot & 63u); }

void putWord(uint slot, inout uint word, uint value) { state[stateIndex(slot, word++)] = value; }
void putFloat(uint slot, inout uint word, float value) { putWord(slot, word, floatBitsToUint(value)); }
void putVec3(uint slot, inout uint word, vec3 v) {
    putFloat(slot, word, v.x);
    putFloat(slot, word, v.y);
    putFloat(slot, word, v.z);
}

uint takeWord(uint slot, inout uint word) { return state[stateIndex(slot, word++)]; }
float takeFloat(uint slot, inout uint word) { return uintBitsToFloat(takeWord(slot, word)); }
vec3 takeVec3(uint slot, inout uint word) {
    float x = takeFloat(slot, word);
    float y = takeFloat(slot, word);
    float z = takeFloat(slot, word);
    return vec3(x, y, z);
}

/// The traversal with its stack: STACK_LEVELS + MINIRT_TRAVERSAL_WORDS words.
void putTraversal(uint slot, inout uint word, Traversal ray) {
    putVec3(slot, word, ray.origin);
    putVec3(slot, word, ray.direction);
    putWord(slot, word, ray.node);
    int level = storeStack(ray.stack);
    putWord(slot, word, uint(level));
    putFloat(slot, word, ray.t);
    putWord(slot, word, ray.slot);
    for (int i = 0; i < level; i++) putWord(slot, word, stackRead(i));
}

Traversal takeTraversal(uint slot, inout uint word, bool anyHit) {
    Traversal ray;
    ray.origin = takeVec3(slot, word);
    ray.direction = takeVec3(slot, word);
    ray.anyHit = anyHit;
    ray.node = takeWord(slot, word);
    int level = int(takeWord(slot, word));
    ray.stack = stackInMemory(level);
    ray.t = takeFloat(slot, word);
    ray.slot = takeWord(slot, word);
    for (int i = 0; i < level; i++) stackWrite(i, takeWord(slot, word));
    return ray;
}
