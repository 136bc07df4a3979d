// What a ray has yet to visit. A GPU keeps it in private memory. A CPU device runs a loop over the lanes of a subgroup, with a branch each,
// for every access to memory that a lane addresses by itself, so there the newest entries stay in registers and memory is touched seldom.

#define NODE_NONE 0xffffffffu

shared uint sharedStack[SHARED_STACK_WORDS];
uint privateStack[PRIVATE_STACK_WORDS + 1u];  // below all entries is NODE_NONE, so that taking one needs no look at how many there are

/// The newest entries, the newest first, NODE_NONE where there is none; and how many older ones lie in memory. On a GPU all do.
struct NodeStack {
    uvec4 newest;
    uvec4 older;
    int level;
};

NodeStack stackInMemory(int level) {
    if (!STACK_IS_SHARED) privateStack[0] = NODE_NONE;
    return NodeStack(uvec4(NODE_NONE), uvec4(NODE_NONE), level);
}

uint stackWord(int level) { return uint(level) * gl_WorkGroupSize.x + gl_LocalInvocationIndex; }

void stackWrite(int level, uint entry) {
    if (STACK_IS_SHARED)
        sharedStack[stackWord(level)] = entry;
    else
        privateStack[level + 1] = entry;
}

uint stackRead(int level) { return STACK_IS_SHARED ? sharedStack[stackWord(level)] : privateStack[level + 1]; }

/// Puts `entry` on the stack where `puts`, or takes the newest into `node` where `takes`, NODE_NONE where there is none; not both. What registers have
/// no room for goes to memory and comes back from there: a lane does one or the other, so an exchange, which is one loop over the lanes, does for both.
void changeStack(inout NodeStack stack, inout uint node, bool puts, uint entry, bool takes) {
    if (STACK_IS_SHARED) {
        bool writes = puts && stack.older.w != NODE_NONE;
        bool reads = takes && stack.newest.x == NODE_NONE && stack.level > 0;
        node = takes ? stack.newest.x : node;
        stack.level -= int(reads);
        if (writes || reads) {
            uint word = atomicExchange(sharedStack[stackWord(stack.level)], stack.older.w);
            node = reads ? word : node;
        }
        stack.level += int(writes);
        uvec4 older = puts ? uvec4(stack.newest.w, stack.older.xyz) : takes ? uvec4(stack.older.yzw, NODE_NONE) : stack.older;
        stack.newest = puts ? uvec4(entry, stack.newest.xyz) : takes ? uvec4(stack.newest.yzw, stack.older.x) : stack.newest;
        stack.older = older;
    } else {
        if (puts) privateStack[stack.level + 1] = entry;
        stack.level += int(puts) - int(takes);
        if (takes) node = privateStack[stack.level + 1];
    }
}

/// Puts all entries into memory and returns how many there are.
int storeStack(NodeStack stack) {
    if (STACK_IS_SHARED) {
        do {
            if (stack.older.w != NODE_NONE) stackWrite(stack.level, stack.older.w);
            stack.level += int(stack.older.w != NODE_NONE);
            stack.older = uvec4(stack.newest.w, stack.older.xyz);
            stack.newest = uvec4(NODE_NONE, stack.newest.xyz);
        } while (any(notEqual(stack.older, uvec4(NODE_NONE))) || any(notEqual(stack.newest, uvec4(NODE_NONE))));
    }
    return stack.level;
}
